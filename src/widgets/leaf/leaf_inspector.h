// The numbers of a leaf, in the order of the work.
#pragma once

#include <QHash>
#include <functional>

#include "model/document/document.h"
#include "model/leaf/stages.h"
#include "widgets/fields/field_panel.h"

class QLabel;

namespace windfall::widgets {

class CheckField;
class ChoiceField;
class Field;
class PresetField;
class InfoField;
class NumberField;
class SeedField;

/// Every row edits the shown leaf through the document; a drag is one undo step.
class LeafInspector : public FieldPanel {
  Q_OBJECT
 public:
  explicit LeafInspector(model::Document& document, QWidget* parent = nullptr);
  void setLeaf(model::AssetId leaf);
  /// Shown in the Source group: "1024 × 768 px".
  void setPhotoSize(QSize size);
  SeedField* seed() const { return seed_; }
  NumberField* laterals() const { return laterals_; }
  /// The number with this id of the project file ("veins.microSpacing"), null: there is none.
  NumberField* number(const QString& id) const { return numbers_.value(id); }
  CheckField* check(const QString& id) const { return checks_.value(id); }
  NumberField* rulerLength() const { return rulerLength_; }
  NumberField* bladeLength() const { return bladeLength_; }
  /// Scrolls to the numbers of this stage.
  void showStage(model::Stage stage);
  /// What the stages found, for the rows that only tell: vertices, real size, veins.
  void showFound(const model::LeafStages* stages);
  PresetField* species() const { return species_; }
  ChoiceField* mapKind() const { return mapKind_; }
  NumberField* age() const { return age_; }
  /// Keeps the leaf's numbers as the artist's own preset; an empty name asks for one.
  void savePreset(QString name);
  /// Takes a preset file, or says in the message area what is wrong with it.
  void importPreset(const QString& path);
  /// Writes the leaf's numbers as a preset file.
  void sharePreset(QString path);

 protected:
  void showEvent(QShowEvent* event) override;

 signals:
  void openPhotoRequested();
  void replacePhotoRequested();
  void loadVeinsRequested();
  /// Index of model::MapKind.
  void mapChosen(int kind);
  void message(const QString& text, bool isError);

 private:
  /// As the panel's own, and known by its id.
  FieldGroup* addGroup(const QString& id, const QString& title);
  void addSource();
  void addContour();
  void addShape();
  void addVeins();
  void addDistance();
  void addRegions();
  void addSynthesis();
  void refresh();
  void addSpecies();
  void addMaps();
  void addAgeing();
  /// A row whose value lies in the parameters.
  NumberField* number(FieldGroup* group, const char* id, const QString& label, const struct NumberSpec& spec,
                      std::function<double(const model::LeafParameters&)> get,
                      std::function<void(model::LeafParameters&, double)> set);
  CheckField* flag(FieldGroup* group, const char* id, const QString& label, bool defaultValue, const QString& help,
                   std::function<bool(const model::LeafParameters&)> get,
                   std::function<void(model::LeafParameters&, bool)> set);
  void edit(const Field* field, const std::function<void(model::LeafParameters&)>& change);

  model::Document& document_;
  model::AssetId leaf_;
  InfoField *file_ = nullptr, *size_ = nullptr, *vertices_ = nullptr, *veinsFound_ = nullptr;
  NumberField *bladeLength_ = nullptr, *laterals_ = nullptr, *rulerLength_ = nullptr;
  SeedField* seed_ = nullptr;
  QHash<QString, NumberField*> numbers_;
  QHash<QString, CheckField*> checks_;
  QHash<QString, FieldGroup*> groups_;
  model::Stage stage_ = model::Stage::Photo;
  bool seen_ = false;
  PresetField* species_ = nullptr;
  ChoiceField* mapKind_ = nullptr;
  NumberField* age_ = nullptr;
  std::vector<std::function<void(const model::Leaf&)>> refreshers_;
};

}  // namespace windfall::widgets
