// Wind, leaves, light, the chosen trees and the device of the scene as fields; every edit is live and undoable.
#pragma once

#include <functional>
#include <vector>

#include "model/document/document.h"
#include "widgets/fields/field_panel.h"
#include "widgets/scene/scene_selection.h"
#include "widgets/scene/simulation_controller.h"

class QLabel;
class QPushButton;

namespace windfall::widgets {

class ChoiceField;
class DialField;
class InfoField;
class NumberField;
class WindCurveEditor;
struct NumberSpec;

class SceneInspector : public FieldPanel {
  Q_OBJECT
 public:
  SceneInspector(model::Document& document, SceneSelection& selection, SimulationController& controller,
                 QWidget* parent = nullptr);

  /// Brings the fields up to date after a change of the document.
  void follow(const model::Change& change);
  /// The name of what draws, once it is known.
  void setRendererName(const QString& name);
  /// Field by its name in the window's texts' language-independent key ("wind.speed"), for tests and links to a place.
  QWidget* field(const QString& key) const;
  void setStreaks(bool on);

 signals:
  void addTreeWanted();
  void duplicateWanted();
  void deleteWanted();
  void fanWanted();
  void fanDeleteWanted();
  /// A table of recorded wind is to be chosen.
  void recordWanted();
  void streaksWanted(bool on);

 private:
  template <class Settings>
  NumberField* number(FieldGroup* group, const QString& key, const QString& label, const NumberSpec& spec,
                      Settings model::Scene::*part, model::Aspect aspect, std::function<double(const Settings&)> get,
                      std::function<void(Settings&, double)> set);
  NumberField* treeNumber(const QString& key, const QString& label, const NumberSpec& spec,
                          std::function<double(const model::TreePlacement&)> get,
                          std::function<void(model::TreePlacement&, double)> set);
  void addWind();
  void addCourse();
  void addFan();
  void showFan();
  void editWind(const std::function<void(sim::WindSettings&)>& edit, const QString& text, const QString& merge = {});
  NumberField* windNumber(FieldGroup* group, const QString& key, const QString& label, const NumberSpec& spec,
                          std::function<double(const sim::WindSettings&)> get,
                          std::function<void(sim::WindSettings&, double)> set);
  NumberField* fanNumber(const QString& key, const QString& label, const NumberSpec& spec,
                         std::function<double(const sim::Fan&)> get, std::function<void(sim::Fan&, double)> set);
  void editFan(const std::function<void(sim::Fan&)>& edit, const QString& text, const QString& merge = {});
  const sim::Fan* chosenFan() const;
  void addLeaves();
  void addLight();
  void addDetail();
  void addSolver();
  void addTrees();
  void addDevice();
  void editTrees(const std::function<void(model::TreePlacement&)>& edit, const QString& text, const QString& merge);
  std::vector<const model::TreePlacement*> chosen() const;
  void showTrees();
  void showDevice();
  void keep(const QString& key, QWidget* field);

  model::Document& document_;
  SceneSelection& selection_;
  SimulationController& controller_;
  std::vector<std::function<void(const model::Scene&)>> shows_;
  std::vector<std::function<void(const std::vector<const model::TreePlacement*>&)>> treeShows_;
  WindCurveEditor* curve_ = nullptr;
  FieldGroup* fan_ = nullptr;
  QLabel* noFan_ = nullptr;
  QPushButton* placeFan_ = nullptr;
  std::vector<QWidget*> fanRows_;
  std::vector<std::function<void(const sim::Fan&)>> fanShows_;
  FieldGroup* trees_ = nullptr;
  QLabel* noTree_ = nullptr;
  std::vector<QWidget*> treeRows_;
  QPushButton* addTree_ = nullptr;
  ChoiceField* plant_ = nullptr;
  InfoField *deviceName_ = nullptr, *rendererName_ = nullptr;
  QLabel* deviceProblem_ = nullptr;
  std::vector<model::AssetId> plants_;
};

/// Degrees clockwise from north (-Z) of a horizontal direction, 0..360; and back.
double compassOf(vec3 direction);
vec3 directionOf(double compass);

}  // namespace windfall::widgets
