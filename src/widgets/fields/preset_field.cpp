#include "widgets/fields/preset_field.h"

namespace windfall::widgets {
namespace {

QStringList namesOf(const std::vector<model::Preset>& presets) {
  QStringList names{PresetField::tr("Default")};
  for (const model::Preset& preset : presets) names << preset.name;
  return names;
}

}  // namespace

PresetField::PresetField(const QString& domain, QWidget* parent)
    : PresetField(model::PresetLibrary().of(domain), parent) {}

PresetField::PresetField(std::vector<model::Preset> presets, QWidget* parent)
    : ChoiceField(tr("Preset"), namesOf(presets), 0, parent), presets_(std::move(presets)) {}

}  // namespace windfall::widgets
