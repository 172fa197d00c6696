// The numbers of a leaf, in the order of the work.
#pragma once

#include <functional>

#include "model/document/document.h"
#include "widgets/fields/field_panel.h"

class QLabel;

namespace windfall::widgets {

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
  PresetField* species() const { return species_; }
  ChoiceField* mapKind() const { return mapKind_; }
  NumberField* age() const { return age_; }
  /// Keeps the leaf's numbers as the artist's own preset; an empty name asks for one.
  void savePreset(QString name);
  /// Takes a preset file, or says in the message area what is wrong with it.
  void importPreset(const QString& path);
  /// Writes the leaf's numbers as a preset file.
  void sharePreset(QString path);

 signals:
  void openPhotoRequested();
  void replacePhotoRequested();
  /// Index of model::MapKind.
  void mapChosen(int kind);
  void message(const QString& text, bool isError);

 private:
  void refresh();
  void addSpecies();
  void addMaps();
  void addAgeing();
  /// A row whose value lies in the parameters.
  NumberField* number(FieldGroup* group, const QString& label, const struct NumberSpec& spec,
                      std::function<double(const model::LeafParameters&)> get,
                      std::function<void(model::LeafParameters&, double)> set);
  void edit(const Field* field, const std::function<void(model::LeafParameters&)>& change);

  model::Document& document_;
  model::AssetId leaf_;
  InfoField *file_, *size_;
  NumberField *bladeLength_, *laterals_;
  SeedField* seed_;
  PresetField* species_ = nullptr;
  ChoiceField* mapKind_ = nullptr;
  NumberField* age_ = nullptr;
  std::vector<std::function<void(const model::Leaf&)>> refreshers_;
};

}  // namespace windfall::widgets
