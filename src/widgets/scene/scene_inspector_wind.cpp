// Wind over time, what stands in its way, and the chosen fan: groups of the scene's inspector.
#include <QLabel>
#include <QPushButton>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "widgets/fields/choice_field.h"
#include "widgets/fields/dial_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/scene/scene_inspector.h"
#include "widgets/scene/wind_curve_editor.h"

namespace windfall::widgets {
namespace {

using Wind = sim::WindSettings;

/// A curve to begin with: a breeze that swells, turns a little and dies down.
std::vector<sim::WindKey> firstCurve() { return {{0, 0.5f, 0}, {6, 1.4f, 0}, {12, 0.8f, 25}, {20, 0.5f, 0}}; }

double tiltOf(const sim::Fan& fan) {
  const double level = std::hypot(static_cast<double>(fan.direction.x), static_cast<double>(fan.direction.z));
  return std::atan2(static_cast<double>(fan.direction.y), level) * 180 / std::numbers::pi;
}

vec3 pointing(double compass, double tilt) {
  const double angle = tilt * std::numbers::pi / 180;
  return directionOf(compass) * static_cast<float>(std::cos(angle)) + vec3(0, static_cast<float>(std::sin(angle)), 0);
}

}  // namespace

void SceneInspector::editWind(const std::function<void(Wind&)>& edit, const QString& text, const QString& merge) {
  Wind wind = document_.project().scene.wind;
  edit(wind);
  document_.setScene(&model::Scene::wind, wind, model::Aspect::Wind, text, merge);
}

NumberField* SceneInspector::windNumber(FieldGroup* group, const QString& key, const QString& label,
                                        const NumberSpec& spec, std::function<double(const Wind&)> get,
                                        std::function<void(Wind&, double)> set) {
  auto* field = group->add(new NumberField(label, spec));
  keep(key, field);
  connect(field, &NumberField::edited, this, [this, field, label, set](double value) {
    editWind([&](Wind& wind) { set(wind, value); }, tr("Change %1").arg(label.toLower()), field->gesture());
  });
  shows_.push_back([field, get = std::move(get)](const model::Scene& scene) { field->setValue(get(scene.wind)); });
  return field;
}

void SceneInspector::addCourse() {
  FieldGroup* group = addGroup("course", tr("Wind over time"));
  auto* course = group->add(new ChoiceField(tr("Course"), {tr("Steady"), tr("Curve"), tr("Recorded")}, 0));
  keep("wind.course", course);
  course->setToolTip(tr("Steady; along a curve that you draw; or as a table of measurements says"));
  curve_ = new WindCurveEditor;
  curve_->setToolTip(tr("Double click adds a point, drag moves it, right click or Delete removes it"));
  group->addWidget(curve_);
  auto* repeat = group->add(new CheckField(tr("Repeat"), true));
  keep("wind.repeat", repeat);
  repeat->setToolTip(tr("Begin anew after the end, instead of staying as it ended"));
  auto* record = group->add(new InfoField(tr("Record")));
  keep("wind.record", record);
  QPushButton* load = group->addButton(tr("Load recorded wind…"), "open");
  load->setObjectName("wind.load");
  load->setToolTip(tr("A CSV table of time, speed and direction; it is kept in the project"));
  auto* streaks = group->add(new CheckField(tr("Show the wind"), false));
  keep("wind.streaks", streaks);
  streaks->setToolTip(tr("Threads of air in the view, while it plays (Shift+W)"));

  connect(course, &ChoiceField::edited, this, [this](int index) {
    const auto wanted = static_cast<sim::WindCourse>(index);
    const Wind& now = document_.project().scene.wind;
    if (wanted == sim::WindCourse::Recorded && now.records.empty()) {
      // Until there is a record the choice stays as it is.
      for (const auto& show : shows_) show(document_.project().scene);
      emit recordWanted();
      return;
    }
    editWind(
        [&](Wind& wind) {
          wind.course = wanted;
          if (wanted == sim::WindCourse::Curve && wind.curve.empty()) wind.curve = firstCurve();
        },
        tr("Choose the wind's course"));
  });
  connect(curve_, &WindCurveEditor::edited, this,
          [this](const std::vector<sim::WindKey>& keys, const QString& text, const QString& gesture) {
            editWind([&](Wind& wind) { wind.curve = keys; }, text, gesture);
          });
  connect(repeat, &CheckField::edited, this,
          [this](bool on) { editWind([&](Wind& wind) { wind.repeat = on; }, tr("Change how the wind repeats")); });
  connect(load, &QPushButton::clicked, this, &SceneInspector::recordWanted);
  connect(streaks, &CheckField::edited, this, [this](bool on) { emit streaksWanted(on); });
  connect(&controller_, &SimulationController::reported, this,
          [this] { curve_->setTime(controller_.last().statistics.time); });
  shows_.push_back([this, course, repeat, record](const model::Scene& scene) {
    const Wind& wind = scene.wind;
    course->setValue(static_cast<int>(wind.course));
    curve_->show(wind);
    curve_->setVisible(wind.course != sim::WindCourse::Steady);
    repeat->setVisible(wind.course != sim::WindCourse::Steady);
    repeat->setValue(wind.repeat);
    record->setVisible(!wind.records.empty());
    if (wind.records.empty()) return;
    record->setValue(
        tr("%1, %n rows", nullptr, static_cast<int>(wind.records.size())).arg(QString::fromStdString(wind.recordName)));
  });

  FieldGroup* around = addGroup("surroundings", tr("Surroundings of the wind"));
  windNumber(
      around, "wind.canopy", tr("Stand around"),
      {.maximum = 40, .defaultValue = 0, .decimals = 1, .unit = "m", .hardMaximum = 100},
      [](const Wind& w) { return static_cast<double>(w.canopyHeight); },
      [](Wind& w, double v) { w.canopyHeight = static_cast<float>(v); })
      ->setToolTip(tr("Height of a forest that the scene is part of: calm below its crowns. 0: open ground"));
  windNumber(
      around, "wind.shelter", tr("Shelter"), {.maximum = 1, .defaultValue = 1},
      [](const Wind& w) { return static_cast<double>(w.shelter); },
      [](Wind& w, double v) { w.shelter = static_cast<float>(v); })
      ->setToolTip(tr("How much leaves slow the air behind them, in their own crown and in the next tree's"));
}

void SceneInspector::setStreaks(bool on) {
  if (auto* field = findChild<CheckField*>("wind.streaks")) field->setValue(on);
}

const sim::Fan* SceneInspector::chosenFan() const {
  const auto& fans = document_.project().scene.wind.fans;
  const int chosen = selection_.fan();
  return chosen >= 0 && chosen < static_cast<int>(fans.size()) ? &fans[static_cast<std::size_t>(chosen)] : nullptr;
}

void SceneInspector::editFan(const std::function<void(sim::Fan&)>& edit, const QString& text, const QString& merge) {
  if (chosenFan() == nullptr) return;
  editWind([&](Wind& wind) { edit(wind.fans[static_cast<std::size_t>(selection_.fan())]); }, text, merge);
}

NumberField* SceneInspector::fanNumber(const QString& key, const QString& label, const NumberSpec& spec,
                                       std::function<double(const sim::Fan&)> get,
                                       std::function<void(sim::Fan&, double)> set) {
  auto* field = fan_->add(new NumberField(label, spec));
  keep(key, field);
  fanRows_.push_back(field);
  connect(field, &NumberField::edited, this, [this, field, label, set](double value) {
    editFan([&](sim::Fan& fan) { set(fan, value); }, tr("Change %1 of a fan").arg(label.toLower()), field->gesture());
  });
  fanShows_.push_back([field, get = std::move(get)](const sim::Fan& fan) { field->setValue(get(fan)); });
  return field;
}

void SceneInspector::addFan() {
  fan_ = addGroup("fan", tr("Fan"));
  noFan_ = new QLabel(tr("With the fan tool (F), click the ground to place a fan; drag it and the tip of its arrow."));
  noFan_->setProperty("hint", true);
  noFan_->setWordWrap(true);
  fan_->addWidget(noFan_);
  auto* on = fan_->add(new CheckField(tr("Blows"), true));
  keep("fan.on", on);
  fanRows_.push_back(on);
  connect(on, &CheckField::edited, this,
          [this](bool value) { editFan([&](sim::Fan& fan) { fan.on = value; }, tr("Switch a fan")); });
  fanShows_.push_back([on](const sim::Fan& fan) { on->setValue(fan.on); });
  fanNumber(
      "fan.strength", tr("Strength"),
      {.maximum = 40, .defaultValue = 12, .decimals = 1, .unit = "m/s", .hardMaximum = 100},
      [](const sim::Fan& f) { return static_cast<double>(f.strength); },
      [](sim::Fan& f, double v) { f.strength = static_cast<float>(v); })
      ->setToolTip(tr("Speed of the air at its outlet"));
  fanNumber(
      "fan.radius", tr("Radius"),
      {.minimum = 0.1,
       .maximum = 3,
       .defaultValue = 0.6,
       .unit = "m",
       .logarithmic = true,
       .hardMinimum = 0.02,
       .hardMaximum = 20},
      [](const sim::Fan& f) { return static_cast<double>(f.radius); },
      [](sim::Fan& f, double v) { f.radius = static_cast<float>(v); });
  fanNumber(
      "fan.spread", tr("Spread"), {.minimum = 2, .maximum = 45, .defaultValue = 11, .decimals = 0, .unit = "°"},
      [](const sim::Fan& f) { return static_cast<double>(f.spread); },
      [](sim::Fan& f, double v) { f.spread = static_cast<float>(v); })
      ->setToolTip(tr("Between the axis and the edge of its jet; 11° is a free jet"));
  auto* heading = fan_->add(new DialField(tr("Blows to"), 90, true));
  keep("fan.heading", heading);
  fanRows_.push_back(heading);
  connect(heading, &DialField::edited, this, [this, heading](double degrees) {
    editFan([&](sim::Fan& fan) { fan.direction = pointing(degrees, tiltOf(fan)); }, tr("Turn a fan"),
            heading->gesture());
  });
  fanShows_.push_back(
      [heading](const sim::Fan& fan) { heading->setValue(std::round(compassOf(fan.direction) * 100) / 100); });
  fanNumber(
      "fan.tilt", tr("Tilt"), {.minimum = -80, .maximum = 80, .defaultValue = 0, .decimals = 0, .unit = "°"},
      [](const sim::Fan& f) { return std::round(tiltOf(f)); },
      [](sim::Fan& f, double v) { f.direction = pointing(compassOf(f.direction), v); })
      ->setToolTip(tr("Upward, above level"));
  fanNumber(
      "fan.height", tr("Height"),
      {.minimum = 0.1, .maximum = 15, .defaultValue = 2, .decimals = 2, .unit = "m", .hardMaximum = 200},
      [](const sim::Fan& f) { return static_cast<double>(f.position.y); },
      [](sim::Fan& f, double v) { f.position.y = static_cast<float>(v); });
  QPushButton* remove = fan_->addButton(tr("Remove the fan"), "delete");
  remove->setObjectName("fan.remove");
  fanRows_.push_back(remove);
  placeFan_ = fan_->addButton(tr("Place a fan"), "fan");
  placeFan_->setObjectName("fan.place");
  connect(remove, &QPushButton::clicked, this, &SceneInspector::fanDeleteWanted);
  connect(placeFan_, &QPushButton::clicked, this, &SceneInspector::fanWanted);
}

void SceneInspector::showFan() {
  const sim::Fan* fan = chosenFan();
  noFan_->setVisible(fan == nullptr);
  for (QWidget* row : fanRows_) row->setVisible(fan != nullptr);
  if (fan == nullptr) return;
  for (const auto& show : fanShows_) show(*fan);
}

}  // namespace windfall::widgets
