#include "widgets/scene/scene_inspector.h"

#include <QLabel>
#include <QPushButton>
#include <cmath>
#include <numbers>

#include "widgets/fields/choice_field.h"
#include "widgets/fields/dial_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/fields/preset_field.h"

namespace windfall::widgets {
namespace {

constexpr double kDegrees = std::numbers::pi / 180;

QString changeText(const QString& label) { return SceneInspector::tr("Change %1").arg(label.toLower()); }

}  // namespace

double compassOf(vec3 direction) {
  const double degrees = std::atan2(static_cast<double>(direction.x), static_cast<double>(-direction.z)) / kDegrees;
  return degrees < 0 ? degrees + 360 : degrees;
}

vec3 directionOf(double compass) {
  return {static_cast<float>(std::sin(compass * kDegrees)), 0, static_cast<float>(-std::cos(compass * kDegrees))};
}

SceneInspector::SceneInspector(model::Document& document, SceneSelection& selection, SimulationController& controller,
                               QWidget* parent)
    : FieldPanel("scene", parent), document_(document), selection_(selection), controller_(controller) {
  addWind();
  addCourse();
  addFan();
  addLeaves();
  addTrees();
  addLight();
  addDetail();
  addSolver();
  addDevice();
  connect(&selection_, &SceneSelection::changed, this, &SceneInspector::showTrees);
  connect(&selection_, &SceneSelection::fanChanged, this, &SceneInspector::showFan);
  connect(&controller_, &SimulationController::reported, this, &SceneInspector::showDevice);
  follow({});
}

void SceneInspector::keep(const QString& key, QWidget* field) { field->setObjectName(key); }
QWidget* SceneInspector::field(const QString& key) const { return findChild<QWidget*>(key); }

template <class Settings>
NumberField* SceneInspector::number(FieldGroup* group, const QString& key, const QString& label, const NumberSpec& spec,
                                    Settings model::Scene::*part, model::Aspect aspect,
                                    std::function<double(const Settings&)> get,
                                    std::function<void(Settings&, double)> set) {
  auto* field = group->add(new NumberField(label, spec));
  keep(key, field);
  connect(field, &NumberField::edited, this, [this, field, label, part, aspect, set](double value) {
    Settings settings = document_.project().scene.*part;
    set(settings, value);
    document_.setScene(part, settings, aspect, changeText(label), field->gesture());
  });
  shows_.push_back([field, part, get](const model::Scene& scene) { field->setValue(get(scene.*part)); });
  return field;
}

void SceneInspector::addWind() {
  using Wind = sim::WindSettings;
  const auto part = &model::Scene::wind;
  FieldGroup* group = addGroup("wind", tr("Wind"));
  auto* preset = group->add(new PresetField("wind"));
  keep("wind.preset", preset);
  // Where it blows to, when it ends and its seed belong to the scene, not to a kind of wind.
  const auto fresh = [](const Wind& now) {
    Wind wind;
    wind.direction = now.direction;
    wind.until = now.until;
    wind.seed = now.seed;
    wind.canopyHeight = now.canopyHeight;
    wind.shelter = now.shelter;
    wind.course = now.course;
    wind.repeat = now.repeat;
    wind.curve = now.curve;
    wind.records = now.records;
    wind.recordName = now.recordName;
    wind.fans = now.fans;
    return wind;
  };
  connect(preset, &PresetField::edited, this, [this, preset, part, fresh](int index) {
    const Wind& now = document_.project().scene.wind;
    document_.setScene(part, preset->chosen(index, now, fresh(now)), model::Aspect::Wind, tr("Choose a kind of wind"));
  });
  shows_.push_back([preset, fresh](const model::Scene& scene) { preset->show(scene.wind, fresh(scene.wind)); });
  number<Wind>(
      group, "wind.speed", tr("Speed"),
      {.maximum = 25, .defaultValue = 5, .decimals = 1, .unit = "m/s", .hardMaximum = 60}, part, model::Aspect::Wind,
      [](const Wind& w) { return w.speed; }, [](Wind& w, double v) { w.speed = static_cast<float>(v); })
      ->setToolTip(tr("Mean speed 10 m above the ground"));
  auto* direction = group->add(new DialField(tr("Blows to"), 90, true));
  keep("wind.direction", direction);
  direction->setToolTip(tr("Where the wind blows to, clockwise from north"));
  connect(direction, &DialField::edited, this, [this, direction, part](double degrees) {
    Wind wind = document_.project().scene.wind;
    wind.direction = directionOf(degrees);
    document_.setScene(part, wind, model::Aspect::Wind, tr("Turn the wind"), direction->gesture());
  });
  shows_.push_back([direction](const model::Scene& scene) {
    direction->setValue(std::round(compassOf(scene.wind.direction) * 100) / 100);
  });
  number<Wind>(
      group, "wind.turbulence", tr("Turbulence"), {.maximum = 0.6, .defaultValue = 0.2}, part, model::Aspect::Wind,
      [](const Wind& w) { return w.turbulence; }, [](Wind& w, double v) { w.turbulence = static_cast<float>(v); })
      ->setToolTip(tr("How much the speed varies, as a share of its mean"));
  number<Wind>(
      group, "wind.gustStrength", tr("Gusts"), {.maximum = 1.5, .defaultValue = 0.6}, part, model::Aspect::Wind,
      [](const Wind& w) { return w.gustStrength; }, [](Wind& w, double v) { w.gustStrength = static_cast<float>(v); })
      ->setToolTip(tr("Strength of the fronts that travel with the wind"));
  number<Wind>(
      group, "wind.gustPeriod", tr("Gust every"),
      {.minimum = 1,
       .maximum = 30,
       .defaultValue = 9,
       .decimals = 1,
       .unit = "s",
       .hardMinimum = 0.5,
       .hardMaximum = 300},
      part, model::Aspect::Wind, [](const Wind& w) { return w.gustPeriod; },
      [](Wind& w, double v) { w.gustPeriod = static_cast<float>(v); });
  auto* seed = group->add(new SeedField(tr("Seed")));
  keep("wind.seed", seed);
  connect(seed, &SeedField::edited, this, [this, seed, part](quint64 value) {
    Wind wind = document_.project().scene.wind;
    wind.seed = value;
    document_.setScene(part, wind, model::Aspect::Wind, tr("Draw another wind"), seed->gesture());
  });
  shows_.push_back([seed](const model::Scene& scene) { seed->setValue(scene.wind.seed); });
}

void SceneInspector::addLeaves() {
  using Leaves = sim::LeafSettings;
  const auto part = &model::Scene::leaves;
  const auto aspect = model::Aspect::FallingLeaves;
  FieldGroup* group = addGroup("leaves", tr("Falling leaves"));
  auto* every = group->add(new CheckField(tr("Every leaf"), true));
  keep("leaves.every", every);
  every->setToolTip(tr("One at each place of the trees; else a number of your own"));
  NumberField* count = number<Leaves>(
      group, "leaves.count", tr("Leaves"),
      {.minimum = 1,
       .maximum = 200000,
       .defaultValue = 2000,
       .decimals = 0,
       .logarithmic = true,
       .hardMinimum = 0,
       .hardMaximum = 5000000},
      part, aspect, [](const Leaves& l) { return l.count == model::kEveryLeaf ? Leaves().count : l.count; },
      [](Leaves& l, double v) { l.count = static_cast<std::int32_t>(v); });
  connect(every, &CheckField::edited, this, [this, part](bool on) {
    Leaves leaves = document_.project().scene.leaves;
    leaves.count = on ? model::kEveryLeaf : Leaves().count;
    document_.setScene(part, leaves, model::Aspect::FallingLeaves, tr("Change the number of leaves"));
  });
  shows_.push_back([every, count](const model::Scene& scene) {
    const bool all = scene.leaves.count == model::kEveryLeaf;
    every->setValue(all);
    count->setEnabled(!all);
  });
  number<Leaves>(
      group, "leaves.season", tr("Season"), {.maximum = 1, .defaultValue = 0.75}, part, aspect,
      [](const Leaves& l) { return l.season; }, [](Leaves& l, double v) { l.season = static_cast<float>(v); })
      ->setToolTip(tr("From 0, green and firm, to 1, ready to drop"));
  number<Leaves>(
      group, "leaves.massPerArea", tr("Mass per area"),
      {.minimum = 20,
       .maximum = 300,
       .defaultValue = 100,
       .decimals = 0,
       .unit = "g/m²",
       .hardMinimum = 5,
       .hardMaximum = 2000},
      part, aspect, [](const Leaves& l) { return std::round(l.massPerArea * 1e6f) / 1e3; },
      [](Leaves& l, double v) { l.massPerArea = static_cast<float>(v / 1000); })
      ->setToolTip(tr("Heavy leaves fall fast, light ones are carried away"));
  number<Leaves>(
      group, "leaves.spawnHeight", tr("Start height"),
      {.maximum = 50, .defaultValue = 0, .decimals = 1, .unit = "m", .hardMaximum = 500}, part, aspect,
      [](const Leaves& l) { return l.spawnHeight; }, [](Leaves& l, double v) { l.spawnHeight = static_cast<float>(v); })
      ->setToolTip(tr("Above 0 the leaves start loose in the air instead of on the trees"));
  auto* respawn = group->add(new CheckField(tr("Grow again"), false));
  keep("leaves.respawn", respawn);
  respawn->setToolTip(tr("A leaf on the ground grows again at its place after a while"));
  connect(respawn, &CheckField::edited, this, [this, part](bool on) {
    Leaves leaves = document_.project().scene.leaves;
    leaves.respawn = on;
    document_.setScene(part, leaves, model::Aspect::FallingLeaves, tr("Change how leaves grow again"));
  });
  shows_.push_back([respawn](const model::Scene& scene) { respawn->setValue(scene.leaves.respawn); });
}

void SceneInspector::addLight() {
  using Light = model::Light;
  const auto part = &model::Scene::light;
  FieldGroup* group = addGroup("light", tr("Light"));
  auto* azimuth = group->add(new DialField(tr("Sun from"), Light().azimuth, true));
  keep("light.azimuth", azimuth);
  connect(azimuth, &DialField::edited, this, [this, azimuth, part](double degrees) {
    Light light = document_.project().scene.light;
    light.azimuth = degrees;
    document_.setScene(part, light, model::Aspect::Light, tr("Move the sun"), azimuth->gesture());
  });
  shows_.push_back([azimuth](const model::Scene& scene) { azimuth->setValue(scene.light.azimuth); });
  number<Light>(
      group, "light.elevation", tr("Sun's height"),
      {.minimum = 2,
       .maximum = 90,
       .defaultValue = Light().elevation,
       .decimals = 1,
       .unit = "°",
       .hardMinimum = 0,
       .hardMaximum = 90},
      part, model::Aspect::Light, [](const Light& l) { return l.elevation; },
      [](Light& l, double v) { l.elevation = v; });
  number<Light>(
      group, "light.strength", tr("Strength"), {.maximum = 3, .defaultValue = 1, .hardMaximum = 10}, part,
      model::Aspect::Light, [](const Light& l) { return l.strength; }, [](Light& l, double v) { l.strength = v; });
}

void SceneInspector::addDetail() {
  using Detail = model::DetailSettings;
  const auto part = &model::Scene::detail;
  FieldGroup* group = addGroup("detail", tr("Detail"));
  auto* wood = group->add(new ChoiceField(tr("Wood"), {tr("Adaptive"), tr("Full")}, 0));
  keep("detail.adaptive", wood);
  wood->setToolTip(tr("Adaptive draws fine where the camera is near; full draws every tree's whole mesh"));
  connect(wood, &ChoiceField::edited, this, [this, part](int index) {
    Detail detail = document_.project().scene.detail;
    detail.adaptive = index == 0;
    document_.setScene(part, detail, model::Aspect::Light, tr("Choose the detail of wood"));
  });
  shows_.push_back([wood](const model::Scene& scene) { wood->setValue(scene.detail.adaptive ? 0 : 1); });
  number<Detail>(
      group, "detail.tolerance", tr("Tolerance"),
      {.minimum = 0.25, .maximum = 2, .defaultValue = 0.5, .unit = "px", .hardMinimum = 0.1, .hardMaximum = 4}, part,
      model::Aspect::Light, [](const Detail& d) { return d.tolerance; }, [](Detail& d, double v) { d.tolerance = v; })
      ->setToolTip(tr("How far adaptive wood may be off in the picture"));
  auto* leaves = group->add(new ChoiceField(tr("Leaves"), {tr("Cards far away"), tr("Every leaf")}, 0));
  keep("detail.cards", leaves);
  leaves->setToolTip(
      tr("Far away, pictures of clusters, painted from the tree's own leaves, stand for the leaves themselves; without "
         "a graphics card only as soon as nothing moves"));
  connect(leaves, &ChoiceField::edited, this, [this, part](int index) {
    Detail detail = document_.project().scene.detail;
    detail.cards = index == 0;
    document_.setScene(part, detail, model::Aspect::Light, tr("Choose the detail of leaves"));
  });
  shows_.push_back([leaves](const model::Scene& scene) { leaves->setValue(scene.detail.cards ? 0 : 1); });
  number<Detail>(
      group, "detail.cardsBelow", tr("Cards below"),
      {.minimum = 0.5, .maximum = 4, .defaultValue = 1.5, .unit = "px", .hardMinimum = 0.1, .hardMaximum = 10}, part,
      model::Aspect::Light, [](const Detail& d) { return d.cardsBelow; }, [](Detail& d, double v) { d.cardsBelow = v; })
      ->setToolTip(
          tr("Length that a leaf has in the picture where its cluster becomes a card: more brings cards nearer"));
}

void SceneInspector::follow(const model::Change& change) {
  switch (change.aspect) {
    case model::Aspect::Everything:
    case model::Aspect::Wind:
    case model::Aspect::FallingLeaves:
    case model::Aspect::Light:
    case model::Aspect::Solver:
      for (const auto& show : shows_) show(document_.project().scene);
      showFan();
      if (change.aspect == model::Aspect::Everything) showTrees();
      break;
    case model::Aspect::Assets:
    case model::Aspect::SceneTrees:
      showTrees();
      break;
    default:
      break;
  }
}

}  // namespace windfall::widgets
