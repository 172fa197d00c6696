// The plant itself: which is shown, how it was grown or what its file holds, which leaves hang on it.
#pragma once

#include <QObject>
#include <functional>
#include <vector>

#include "model/document/document.h"
#include "model/scene/assemble.h"
#include "widgets/fields/field_panel.h"

namespace windfall::widgets {

class CheckField;
class ChoiceField;
class GrowthFields;
class InfoField;
class NumberField;
class PresetField;
class SeedField;
struct NumberSpec;

class PlantSettings : public QObject {
  Q_OBJECT
 public:
  /// Adds its groups to `panel`.
  PlantSettings(model::Document& document, FieldPanel& panel, QObject* parent = nullptr);

  /// The plant shown (0: none), and what was made of it once that is known.
  void show(model::AssetId plant, const model::LoadedPlant& loaded);
  /// Wind of this workspace's view, m/s.
  double wind() const;
  void setWind(double speed);

 signals:
  void plantChosen(windfall::model::AssetId plant);
  void windChanged(double speed);
  void importWanted();
  void growWanted();
  /// One line on what could not be done.
  void problem(const QString& text);

 private:
  NumberField* grower(const QString& key, const QString& label, const NumberSpec& spec,
                      std::function<double(const model::GrowerSettings&)> get,
                      std::function<void(model::GrowerSettings&, double)> set);
  void edit(const std::function<void(model::GrowerSettings&)>& change, const QString& text, const QString& merge);
  void showInfo(const model::LoadedPlant& loaded);
  void showLeaves();
  void hang(model::AssetId leaf, bool on);

  model::Document& document_;
  model::AssetId plant_;
  const void* described_ = nullptr;
  std::vector<model::AssetId> plants_;
  ChoiceField* choice_;
  FieldGroup *grower_, *info_, *leaves_;
  PresetField* preset_;
  GrowthFields* growth_;
  SeedField* seed_;
  std::vector<std::function<void(const model::GrowerSettings&)>> shows_;
  std::vector<QWidget*> ruleRows_;  ///< of the plain rule only
  InfoField *source_, *bones_, *height_, *mass_, *frequency_;
  NumberField *density_, *wind_;
  QWidget* noLeaves_;
  struct LeafRow {
    model::AssetId leaf;
    CheckField* field;
  };
  std::vector<LeafRow> leafRows_;
};

}  // namespace windfall::widgets
