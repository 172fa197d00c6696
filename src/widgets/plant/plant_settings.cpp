#include "widgets/plant/plant_settings.h"

#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <algorithm>

#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/fields/preset_field.h"
#include "widgets/plant/growth_fields.h"

namespace windfall::widgets {

using model::GrowerSettings;

namespace {

/// The defaults, with the seed kept: it says which plant, not what kind.
GrowerSettings fresh(const GrowerSettings& now) {
  GrowerSettings settings;
  settings.seed = now.seed;
  return settings;
}

}  // namespace

PlantSettings::PlantSettings(model::Document& document, FieldPanel& panel, QObject* parent)
    : QObject(parent), document_(document) {
  FieldGroup* plant = panel.addGroup("plant", tr("Plant"));
  choice_ = plant->add(new ChoiceField(tr("Shown"), {}, 0));
  choice_->setObjectName("plant.shown");
  connect(choice_, &ChoiceField::edited, this, [this](int index) {
    if (index >= 0 && index < static_cast<int>(plants_.size())) {
      emit plantChosen(plants_[static_cast<std::size_t>(index)]);
    }
  });
  wind_ = plant->add(new NumberField(
      tr("Wind here"), {.maximum = 25, .defaultValue = 4, .decimals = 1, .unit = "m/s", .hardMaximum = 60}));
  wind_->setObjectName("plant.wind");
  wind_->setToolTip(tr("To try the branches out; the scene has its own wind"));
  wind_->setValue(4);
  connect(wind_, &NumberField::edited, this, &PlantSettings::windChanged);
  connect(plant->addButton(tr("Import a plant…"), "import"), &QPushButton::clicked, this, &PlantSettings::importWanted);
  connect(plant->addButton(tr("Grow a plant"), "plant"), &QPushButton::clicked, this, &PlantSettings::growWanted);

  info_ = panel.addGroup("info", tr("About the plant"));
  source_ = info_->add(new InfoField(tr("From")));
  source_->setObjectName("plant.source");
  bones_ = info_->add(new InfoField(tr("Bones")));
  bones_->setObjectName("plant.bones");
  height_ = info_->add(new InfoField(tr("Size")));
  mass_ = info_->add(new InfoField(tr("Mass")));
  frequency_ = info_->add(new InfoField(tr("First sway")));

  grower_ = panel.addGroup("grower", tr("Growth"));
  preset_ = grower_->add(new PresetField("grower"));
  preset_->setObjectName("grower.preset");
  connect(preset_, &PresetField::edited, this, [this](int index) {
    const auto choose = [&](GrowerSettings& g) { g = preset_->chosen(index, g, fresh(g)); };
    edit(choose, tr("Choose a kind of growth"), {});
  });
  seed_ = grower_->add(new SeedField(tr("Seed")));
  seed_->setObjectName("grower.seed");
  connect(seed_, &SeedField::edited, this, [this](quint64 value) {
    edit([&](GrowerSettings& g) { g.seed = value; }, tr("Grow another plant"), seed_->gesture());
  });
  grower(
      "grower.height", tr("Height"),
      {.minimum = 1,
       .maximum = 30,
       .defaultValue = 8,
       .decimals = 1,
       .unit = "m",
       .hardMinimum = 0.2,
       .hardMaximum = 120},
      [](const GrowerSettings& g) { return g.height; }, [](GrowerSettings& g, double v) { g.height = v; });
  grower(
      "grower.baseRadius", tr("Trunk's radius"),
      {.minimum = 1,
       .maximum = 60,
       .defaultValue = 11,
       .decimals = 1,
       .unit = "cm",
       .hardMinimum = 0.2,
       .hardMaximum = 300},
      [](const GrowerSettings& g) { return g.baseRadius * 100; },
      [](GrowerSettings& g, double v) { g.baseRadius = v / 100; });
  ruleRows_.push_back(grower(
      "grower.limbs", tr("Limbs"), {.minimum = 0, .maximum = 60, .defaultValue = 26, .decimals = 0, .hardMaximum = 300},
      [](const GrowerSettings& g) { return g.limbs; },
      [](GrowerSettings& g, double v) { g.limbs = static_cast<int>(v); }));
  ruleRows_.push_back(grower(
      "grower.levels", tr("Levels"), {.minimum = 1, .maximum = 4, .defaultValue = 3, .decimals = 0},
      [](const GrowerSettings& g) { return g.levels; },
      [](GrowerSettings& g, double v) { g.levels = static_cast<int>(v); }));
  ruleRows_.back()->setToolTip(tr("1 trunk, 2 limbs, 3 twigs"));
  ruleRows_.push_back(grower(
      "grower.spread", tr("Spread"),
      {.minimum = 10,
       .maximum = 100,
       .defaultValue = 55,
       .decimals = 0,
       .unit = "°",
       .hardMinimum = 0,
       .hardMaximum = 140},
      [](const GrowerSettings& g) { return g.spread; }, [](GrowerSettings& g, double v) { g.spread = v; }));
  ruleRows_.back()->setToolTip(tr("Angle between a limb and the trunk"));
  growth_ = new GrowthFields(document_, panel, *grower_, this);
  connect(growth_, &GrowthFields::problem, this, &PlantSettings::problem);
  connect(growth_, &GrowthFields::methodShown, this, [this](bool byRule) {
    for (QWidget* row : ruleRows_) row->setVisible(byRule);
  });

  leaves_ = panel.addGroup("hanging", tr("Leaves on the plant"));
  density_ =
      leaves_->add(new NumberField(tr("Density"), {.maximum = 2, .defaultValue = 1, .unit = "×", .hardMaximum = 20}));
  density_->setObjectName("plant.leafDensity");
  density_->setToolTip(tr("Share of the natural number"));
  connect(density_, &NumberField::edited, this, [this](double value) {
    document_.setPlant(plant_, &model::Plant::leafDensity, value, model::Aspect::PlantLeaves,
                       tr("Change how dense leaves hang"), density_->gesture());
  });
  auto* hint = new QLabel(tr("Make a leaf in the Leaf workspace; until then plain leaves hang here."));
  hint->setWordWrap(true);
  hint->setProperty("hint", true);
  noLeaves_ = hint;
  leaves_->addWidget(noLeaves_);
  show({}, {});
}

NumberField* PlantSettings::grower(const QString& key, const QString& label, const NumberSpec& spec,
                                   std::function<double(const GrowerSettings&)> get,
                                   std::function<void(GrowerSettings&, double)> set) {
  auto* field = grower_->add(new NumberField(label, spec));
  field->setObjectName(key);
  connect(field, &NumberField::edited, this, [this, field, label, set = std::move(set)](double value) {
    edit([&](GrowerSettings& g) { set(g, value); }, tr("Change %1 of growth").arg(label.toLower()), field->gesture());
  });
  shows_.push_back([field, get = std::move(get)](const GrowerSettings& settings) { field->setValue(get(settings)); });
  return field;
}

void PlantSettings::edit(const std::function<void(GrowerSettings&)>& change, const QString& text,
                         const QString& merge) {
  const model::Plant* plant = document_.project().plant(plant_);
  if (plant == nullptr || !plant->grower) return;
  std::optional<GrowerSettings> settings = plant->grower;
  change(*settings);
  document_.setPlant(plant_, &model::Plant::grower, settings, model::Aspect::PlantSource, text, merge);
}

double PlantSettings::wind() const { return wind_->value(); }
void PlantSettings::setWind(double speed) { wind_->setValue(speed); }

void PlantSettings::show(model::AssetId shown, const model::LoadedPlant& loaded) {
  plant_ = shown;
  const model::Plant* plant = document_.project().plant(shown);
  plants_.clear();
  QStringList names;
  for (const model::Plant& each : document_.project().plants) {
    plants_.push_back(each.id);
    names << each.name;
  }
  {
    const QSignalBlocker blocker(choice_->box());
    choice_->box()->clear();
    choice_->box()->addItems(names);
  }
  choice_->setVisible(!plants_.empty());
  if (plant != nullptr)
    choice_->setValue(static_cast<int>(std::find(plants_.begin(), plants_.end(), shown) - plants_.begin()));
  wind_->setVisible(plant != nullptr);
  grower_->setVisible(plant != nullptr && plant->grower.has_value());
  info_->setVisible(plant != nullptr && loaded.geometry != nullptr);
  leaves_->setVisible(plant != nullptr);
  growth_->show(shown);
  if (plant == nullptr) return;
  if (plant->grower) {
    preset_->show(*plant->grower, fresh(*plant->grower));
    seed_->setValue(plant->grower->seed);
    for (const auto& showField : shows_) showField(*plant->grower);
  }
  density_->setValue(plant->leafDensity);
  showLeaves();
  showInfo(loaded);
}

void PlantSettings::showInfo(const model::LoadedPlant& loaded) {
  if (!loaded.geometry || !loaded.bodies || described_ == loaded.bodies.get()) return;
  described_ = loaded.bodies.get();
  const model::PlantInfo info = model::describe(*loaded.geometry, *loaded.bodies);
  const model::Plant* plant = document_.project().plant(plant_);
  const QLocale locale;
  source_->setValue(plant->grower ? tr("grown") : plant->file.name);
  bones_->setValue(tr("%1 in %2 branches").arg(locale.toString(info.bones), locale.toString(info.chains)));
  const vec3 size = info.upper - info.lower;
  const auto metres = [&](float value) { return locale.toString(static_cast<double>(value), 'f', 2); };
  height_->setValue(tr("%1 × %2 × %3 m").arg(metres(size.x), metres(size.y), metres(size.z)));
  mass_->setValue(tr("%1 kg").arg(locale.toString(info.mass, 'f', info.mass < 10 ? 2 : 0)));
  frequency_->setValue(tr("%1 Hz").arg(locale.toString(info.firstFrequency, 'f', 2)));
}

void PlantSettings::showLeaves() {
  const model::Project& project = document_.project();
  const bool same = std::equal(leafRows_.begin(), leafRows_.end(), project.leaves.begin(), project.leaves.end(),
                               [](const LeafRow& row, const model::Leaf& leaf) {
                                 return row.leaf == leaf.id && row.field->label() == leaf.name;
                               });
  if (!same) {
    for (const LeafRow& row : leafRows_) row.field->deleteLater();
    leafRows_.clear();
    for (const model::Leaf& leaf : project.leaves) {
      auto* field = leaves_->add(new CheckField(leaf.name, false));
      field->setObjectName(QStringLiteral("plant.leaf.%1").arg(leaf.id.value));
      connect(field, &CheckField::edited, this, [this, id = leaf.id](bool on) { hang(id, on); });
      leafRows_.push_back({leaf.id, field});
    }
  }
  noLeaves_->setVisible(leafRows_.empty());
  const model::Plant* plant = project.plant(plant_);
  for (const LeafRow& row : leafRows_) {
    row.field->setValue(std::find(plant->leaves.begin(), plant->leaves.end(), row.leaf) != plant->leaves.end());
  }
}

void PlantSettings::hang(model::AssetId leaf, bool on) {
  const model::Plant* plant = document_.project().plant(plant_);
  if (plant == nullptr) return;
  std::vector<model::AssetId> leaves = plant->leaves;
  std::erase(leaves, leaf);
  if (on) leaves.push_back(leaf);
  document_.setPlant(plant_, &model::Plant::leaves, leaves, model::Aspect::PlantLeaves,
                     on ? tr("Hang a leaf on a plant") : tr("Take a leaf off a plant"));
}

}  // namespace windfall::widgets
