// A plant's surface: what its branches are, how it is meshed, what bark it has; and which of its data is shown.
#pragma once

#include <QObject>
#include <functional>
#include <vector>

#include "model/document/document.h"
#include "model/plant/plant_data.h"
#include "widgets/fields/field_panel.h"

class QPushButton;

namespace windfall::widgets {

class ChoiceField;
class CheckField;
class DataLegend;
class Field;
class NumberField;
struct NumberSpec;

class SurfacePanel : public QObject {
  Q_OBJECT
 public:
  /// Adds its groups to `panel`.
  SurfacePanel(model::Document& document, FieldPanel& panel, QObject* parent = nullptr);

  /// 0: none.
  void show(model::AssetId plant);
  void showData(const model::LinkData& data);
  model::PlantData data() const;
  void setData(model::PlantData what);
  /// That the plant's file has changed on disk.
  void setChangedOnDisk(bool changed);

 signals:
  void dataChosen();
  void replaceWanted();
  void reloadWanted();

 private:
  using Settings = model::SurfaceSettings;
  NumberField* number(FieldGroup& group, const QString& key, const QString& label, const NumberSpec& spec,
                      std::function<double(const Settings&)> get, std::function<void(Settings&, double)> set);
  ChoiceField* choice(FieldGroup& group, const QString& key, const QString& label, const QStringList& names,
                      int initial, std::function<int(const Settings&)> get, std::function<void(Settings&, int)> set);
  CheckField* check(FieldGroup& group, const QString& key, const QString& label, bool initial, bool Settings::*member);
  void edit(const std::function<void(Settings&)>& change, const QString& text, const QString& merge);

  model::Document& document_;
  model::AssetId plant_;
  FieldGroup *file_, *data_, *branches_, *surface_;
  ChoiceField* shown_;
  DataLegend* legend_;
  QPushButton* reload_;
  std::vector<Field*> weights_;
  Field *anew_, *roots_, *state_;
  std::vector<std::function<void(const Settings&)>> shows_;
};

}  // namespace windfall::widgets
