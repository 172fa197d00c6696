#include "widgets/plant/clip_panel.h"

#include <QLocale>
#include <QPointer>
#include <QPushButton>
#include <algorithm>

#include "model/plant/bake.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"

namespace windfall::widgets {

using model::Clip;

ClipPanel::ClipPanel(model::Document& document, model::JobRunner& jobs, FieldPanel& panel,
                     std::function<sim::WindSettings()> wind, QObject* parent)
    : QObject(parent), document_(document), jobs_(jobs), wind_(std::move(wind)) {
  FieldGroup* group = panel.addGroup("clips", tr("Clips"));
  choice_ = group->add(new ChoiceField(tr("Shown"), {tr("Simulation")}, 0));
  choice_->setObjectName("clip.choice");
  choice_->setToolTip(tr("The simulation, or a recorded motion: baked here or found in the file"));
  about_ = group->add(new InfoField(tr("Keys")));
  about_->setObjectName("clip.about");
  length_ = group->add(new NumberField(tr("Length"), {.minimum = 1,
                                                      .maximum = 20,
                                                      .defaultValue = 6,
                                                      .decimals = 1,
                                                      .unit = "s",
                                                      .hardMinimum = 0.1,
                                                      .hardMaximum = 120}));
  length_->setObjectName("clip.length");
  rate_ = group->add(new NumberField(tr("Rate"), {.minimum = 10,
                                                  .maximum = 60,
                                                  .defaultValue = 30,
                                                  .decimals = 0,
                                                  .unit = "1/s",
                                                  .hardMinimum = 1,
                                                  .hardMaximum = 240}));
  rate_->setObjectName("clip.rate");
  tolerance_ = group->add(new NumberField(
      tr("Tolerance"), {.maximum = 2, .defaultValue = 0.15, .decimals = 2, .unit = "°", .hardMaximum = 45}));
  tolerance_->setObjectName("clip.tolerance");
  tolerance_->setToolTip(tr("How far a branch may differ from the simulation; more leaves fewer keys"));
  loop_ = group->add(new CheckField(tr("Loop"), true));
  loop_->setObjectName("clip.loop");
  loop_->setToolTip(tr("The end blends into the start"));
  bake_ = group->addButton(tr("Bake a clip of this wind"), "record");
  bake_->setObjectName("clip.bake");
  remove_ = group->addButton(tr("Remove the clip"), "delete");
  remove_->setObjectName("clip.remove");
  for (NumberField* field : {length_, rate_, tolerance_}) {
    connect(field, &NumberField::edited, field, [field](double value) { field->setValue(value); });
  }
  connect(loop_, &CheckField::edited, loop_, [this](bool on) { loop_->setValue(on); });
  connect(choice_, &ChoiceField::edited, this, [this](int index) {
    chosenName_ = index <= 0 || index > names_.size() ? QString() : names_[index - 1];
    showChoice();
    emit chosenChanged();
  });
  connect(bake_, &QPushButton::clicked, this, &ClipPanel::bake);
  connect(remove_, &QPushButton::clicked, this, &ClipPanel::remove);
}

std::vector<Clip> ClipPanel::all() const {
  std::vector<Clip> clips;
  if (loaded_.geometry) clips = loaded_.geometry->clips;
  if (const model::Plant* plant = document_.project().plant(plant_)) {
    clips.insert(clips.end(), plant->clips.begin(), plant->clips.end());
  }
  return clips;
}

void ClipPanel::show(model::AssetId plant, const model::LoadedPlant& loaded) {
  if (plant != plant_) chosenName_.clear();
  plant_ = plant;
  loaded_ = loaded;
  QStringList names;
  for (const Clip& clip : all()) names << clip.name;
  const bool lost = !chosenName_.isEmpty() && !names.contains(chosenName_);
  if (lost) chosenName_.clear();
  if (names != names_ || choice_->box()->count() == 0) {
    names_ = names;
    const QSignalBlocker blocker(choice_->box());
    choice_->box()->clear();
    choice_->box()->addItem(tr("Simulation"));
    choice_->box()->addItems(names_);
  }
  showChoice();
  if (lost) emit chosenChanged();
}

void ClipPanel::showChoice() {
  choice_->setValue(static_cast<int>(names_.indexOf(chosenName_)) + 1);
  const auto clip = chosen();
  about_->setVisible(clip != nullptr);
  remove_->setVisible(clip != nullptr && clip->origin == model::ClipOrigin::Baked);
  bake_->setEnabled(loaded_.bodies && !loaded_.bodies->tree.links.empty());
  if (!clip) return;
  const QLocale locale;
  about_->setValue(tr("%1 in %2 s%3")
                       .arg(locale.toString(static_cast<qulonglong>(clip->keyCount())),
                            locale.toString(clip->length, 'f', 1), clip->looping ? tr(", loops") : QString()));
}

std::shared_ptr<const Clip> ClipPanel::chosen() const {
  if (chosenName_.isEmpty()) return nullptr;
  for (Clip& clip : all()) {
    if (clip.name == chosenName_) return std::make_shared<const Clip>(std::move(clip));
  }
  return nullptr;
}

std::shared_ptr<const ClipPlay> ClipPanel::play(const std::shared_ptr<const Clip>& clip,
                                                const model::LoadedPlant& loaded) {
  if (!clip || !loaded.geometry || !loaded.bodies) return nullptr;
  auto play = std::make_shared<ClipPlay>();
  play->pose = [clip, loaded](double time) {
    const std::vector<mat4> bones = model::poseAt(*clip, loaded.geometry->bones, time);
    std::vector<mat4> links;
    links.reserve(loaded.bodies->boneOfLink.size());
    for (const int bone : loaded.bodies->boneOfLink) links.push_back(bones[static_cast<std::size_t>(bone)]);
    return links;
  };
  return play;
}

void ClipPanel::bake() {
  const model::Plant* plant = document_.project().plant(plant_);
  if (plant == nullptr || !loaded_.geometry || !loaded_.bodies) return;
  model::BakeSettings settings;
  settings.length = length_->value();
  settings.rate = rate_->value();
  settings.tolerance = tolerance_->value();
  settings.looping = loop_->value();
  settings.wind = wind_();
  settings.solver = document_.project().scene.solver;
  const QString stem = tr("Wind %1 m/s").arg(QLocale().toString(settings.wind.speed, 'f', 1));
  settings.name = stem;
  for (int copy = 2; names_.contains(settings.name); ++copy)
    settings.name = QStringLiteral("%1 %2").arg(stem).arg(copy);
  jobs_.start<Clip>(
      tr("Baking %1").arg(settings.name), "bake clip",
      [settings, loaded = loaded_](model::Progress& progress) {
        return model::bakeClip(*loaded.geometry, *loaded.bodies, settings, progress);
      },
      [self = QPointer<ClipPanel>(this), plant = plant_](Clip clip) {
        if (self) self->keep(plant, std::move(clip));
      });
}

void ClipPanel::keep(model::AssetId plant, Clip clip) {
  const model::Plant* owner = document_.project().plant(plant);
  if (owner == nullptr) return;
  std::vector<Clip> clips = owner->clips;
  const QString text = tr("%1: %2 keys for %3 bones").arg(clip.name).arg(clip.keyCount()).arg(clip.tracks.size());
  clips.push_back(std::move(clip));
  document_.setPlant(plant, &model::Plant::clips, clips, model::Aspect::PlantClips, tr("Bake a clip"));
  emit message(text, false);
}

void ClipPanel::remove() {
  const model::Plant* plant = document_.project().plant(plant_);
  if (plant == nullptr) return;
  std::vector<Clip> clips = plant->clips;
  std::erase_if(clips, [&](const Clip& clip) { return clip.name == chosenName_; });
  document_.setPlant(plant_, &model::Plant::clips, clips, model::Aspect::PlantClips, tr("Remove a clip"));
}

}  // namespace windfall::widgets
