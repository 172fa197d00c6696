#include "widgets/plant/surface_panel.h"

#include <QPushButton>

#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/plant/data_legend.h"

namespace windfall::widgets {

using model::SurfaceSettings;

SurfacePanel::SurfacePanel(model::Document& document, FieldPanel& panel, QObject* parent)
    : QObject(parent), document_(document) {
  file_ = panel.addGroup("file", tr("File"));
  auto* replace = file_->addButton(tr("Point at another file…"), "open");
  replace->setObjectName("plant.replace");
  replace->setToolTip(tr("Takes the plant from another file and keeps what is set about it"));
  connect(replace, &QPushButton::clicked, this, &SurfacePanel::replaceWanted);
  reload_ = file_->addButton(tr("Load again"), "reset");
  reload_->setObjectName("plant.reload");
  connect(reload_, &QPushButton::clicked, this, &SurfacePanel::reloadWanted);

  data_ = panel.addGroup("data", tr("Colours by data"));
  shown_ = data_->add(new ChoiceField(
      tr("Show"),
      {tr("Bark"), tr("Water"), tr("Energy"), tr("Wood"), tr("Order"), tr("Branch"), tr("Radius"), tr("Stress")}, 0));
  shown_->setObjectName("plant.data");
  shown_->setToolTip(tr("Colours the wood by what is known of it; stress follows the wind"));
  connect(shown_, &ChoiceField::edited, this, &SurfacePanel::dataChosen);
  legend_ = new DataLegend;
  data_->addWidget(legend_);

  branches_ = panel.addGroup("chains", tr("What is a branch"));
  choice(
      *branches_, "chains.rule", tr("Goes on with"), {tr("The longest way"), tr("The best score")}, 1,
      [](const SurfaceSettings& s) { return static_cast<int>(s.chains.rule); },
      [](SurfaceSettings& s, int v) { s.chains.rule = static_cast<model::ChainRule>(v); })
      ->setToolTip(tr("Which child continues a branch, and which one starts a branch of its own"));
  const auto weight = [&](const QString& key, const QString& label, double initial,
                          double model::ChainSettings::*member) {
    weights_.push_back(number(
        *branches_, key, label, {.maximum = 1, .defaultValue = initial},
        [member](const SurfaceSettings& s) { return s.chains.*member; },
        [member](SurfaceSettings& s, double v) { s.chains.*member = v; }));
    weights_.back()->setToolTip(tr("Weight in the score; only the proportions count"));
  };
  weight("chains.angle", tr("Straightness"), 0.35, &model::ChainSettings::angle);
  weight("chains.length", tr("Length"), 0.30, &model::ChainSettings::length);
  weight("chains.thickness", tr("Thickness"), 0.25, &model::ChainSettings::thickness);
  weight("chains.order", tr("Branching"), 0.10, &model::ChainSettings::order);

  surface_ = panel.addGroup("surface", tr("Surface"));
  number(
      *surface_, "surface.scale", tr("Plant's scale"),
      {.minimum = 0.1,
       .maximum = 10,
       .defaultValue = 1,
       .unit = "×",
       .logarithmic = true,
       .hardMinimum = 0.001,
       .hardMaximum = 1000},
      [](const SurfaceSettings& s) { return s.scale; }, [](SurfaceSettings& s, double v) { s.scale = v; });
  anew_ = check(*surface_, "surface.anew", tr("Mesh from the skeleton"), false, &SurfaceSettings::fromSkeleton);
  anew_->setToolTip(tr("Shows round stems along the file's bones instead of the file's own mesh"));
  choice(
      *surface_, "surface.bark", tr("Bark"),
      {tr("Oak"), tr("Birch"), tr("Beech"), tr("Pine"), tr("Maple"), tr("Green stem")}, 0,
      [](const SurfaceSettings& s) { return static_cast<int>(s.bark); },
      [](SurfaceSettings& s, int v) { s.bark = static_cast<model::BarkKind>(v); });
  number(
      *surface_, "surface.tile", tr("Bark's width"),
      {.minimum = 1,
       .maximum = 60,
       .defaultValue = 15,
       .decimals = 1,
       .unit = "cm",
       .logarithmic = true,
       .hardMinimum = 0.1,
       .hardMaximum = 1000},
      [](const SurfaceSettings& s) { return s.tile * 100; }, [](SurfaceSettings& s, double v) { s.tile = v / 100; })
      ->setToolTip(tr("How wide one repeat of the bark's picture is on the stem"));
  number(
      *surface_, "surface.detail", tr("Subdivisions"), {.maximum = 1, .defaultValue = 0.5},
      [](const SurfaceSettings& s) { return s.detail; }, [](SurfaceSettings& s, double v) { s.detail = v; })
      ->setToolTip(tr("0: the mesh strays up to 4 mm from the surface; 1: 0.05 mm"));
  choice(
      *surface_, "surface.curve", tr("Curves"), {tr("Through the joints"), tr("Smoother, near the joints")}, 0,
      [](const SurfaceSettings& s) { return static_cast<int>(s.curve); },
      [](SurfaceSettings& s, int v) { s.curve = static_cast<model::CurveKind>(v); });
  number(
      *surface_, "surface.flare", tr("Root flare"), {.maximum = 1.5, .defaultValue = 0.4},
      [](const SurfaceSettings& s) { return s.flare; }, [](SurfaceSettings& s, double v) { s.flare = v; })
      ->setToolTip(tr("How much a trunk widens at its foot"));
  number(
      *surface_, "surface.lobes", tr("Roots at the foot"), {.maximum = 9, .defaultValue = 5, .decimals = 0},
      [](const SurfaceSettings& s) { return s.lobes; },
      [](SurfaceSettings& s, double v) { s.lobes = static_cast<int>(v); });
  number(
      *surface_, "surface.gnarl", tr("Gnarl"), {.maximum = 0.6, .defaultValue = 0},
      [](const SurfaceSettings& s) { return s.gnarl; }, [](SurfaceSettings& s, double v) { s.gnarl = v; })
      ->setToolTip(tr("Bumps, as a share of the radius"));
  roots_ = check(*surface_, "surface.roots", tr("Show roots"), true, &SurfaceSettings::roots);
  state_ = check(*surface_, "surface.state", tr("Follow wood and water"), true, &SurfaceSettings::followsState);
  state_->setToolTip(tr("Green skin where there is no wood yet, hanging leaves where water is short"));
  show({});
}

model::PlantData SurfacePanel::data() const { return static_cast<model::PlantData>(std::max(shown_->value(), 0)); }

void SurfacePanel::setData(model::PlantData what) {
  shown_->setValue(static_cast<int>(what));
  emit dataChosen();
}

void SurfacePanel::showData(const model::LinkData& data) { legend_->show(this->data(), data); }

void SurfacePanel::setChangedOnDisk(bool changed) {
  reload_->setVisible(changed);
  reload_->setToolTip(tr("The file has changed on disk"));
}

void SurfacePanel::show(model::AssetId shown) {
  plant_ = shown;
  const model::Plant* plant = document_.project().plant(shown);
  for (FieldGroup* group : {data_, branches_, surface_}) group->setVisible(plant != nullptr);
  file_->setVisible(plant != nullptr && !plant->file.isEmpty());
  if (plant == nullptr) return;
  for (const auto& showField : shows_) showField(plant->surface);
  for (Field* field : weights_) field->setVisible(plant->surface.chains.rule == model::ChainRule::Score);
  const QString suffix = plant->file.name.section('.', -1).toLower();
  const bool skeleton = suffix == QLatin1String("prim") || suffix == QLatin1String("json");
  anew_->setVisible(!plant->file.isEmpty() && !skeleton);
  roots_->setVisible(skeleton);
  state_->setVisible(skeleton);
}

void SurfacePanel::edit(const std::function<void(SurfaceSettings&)>& change, const QString& text,
                        const QString& merge) {
  const model::Plant* plant = document_.project().plant(plant_);
  if (plant == nullptr) return;
  SurfaceSettings settings = plant->surface;
  change(settings);
  document_.setPlant(plant_, &model::Plant::surface, settings, model::Aspect::PlantSource, text, merge);
}

NumberField* SurfacePanel::number(FieldGroup& group, const QString& key, const QString& label, const NumberSpec& spec,
                                  std::function<double(const SurfaceSettings&)> get,
                                  std::function<void(SurfaceSettings&, double)> set) {
  auto* field = group.add(new NumberField(label, spec));
  field->setObjectName(key);
  connect(field, &NumberField::edited, this, [this, field, label, set](double value) {
    edit([&](SurfaceSettings& s) { set(s, value); }, tr("Change %1 of a plant").arg(label.toLower()), field->gesture());
  });
  shows_.push_back([field, get = std::move(get)](const SurfaceSettings& settings) { field->setValue(get(settings)); });
  return field;
}

ChoiceField* SurfacePanel::choice(FieldGroup& group, const QString& key, const QString& label, const QStringList& names,
                                  int initial, std::function<int(const SurfaceSettings&)> get,
                                  std::function<void(SurfaceSettings&, int)> set) {
  auto* field = group.add(new ChoiceField(label, names, initial));
  field->setObjectName(key);
  connect(field, &ChoiceField::edited, this, [this, label, set](int value) {
    edit([&](SurfaceSettings& s) { set(s, value); }, tr("Change %1 of a plant").arg(label.toLower()), {});
  });
  shows_.push_back([field, get = std::move(get)](const SurfaceSettings& settings) { field->setValue(get(settings)); });
  return field;
}

CheckField* SurfacePanel::check(FieldGroup& group, const QString& key, const QString& label, bool initial,
                                bool SurfaceSettings::*member) {
  auto* field = group.add(new CheckField(label, initial));
  field->setObjectName(key);
  connect(field, &CheckField::edited, this,
          [this, label, member](bool on) { edit([&](SurfaceSettings& s) { s.*member = on; }, label, {}); });
  shows_.push_back([field, member](const SurfaceSettings& settings) { field->setValue(settings.*member); });
  return field;
}

}  // namespace windfall::widgets
