#include "widgets/fields/preset_field.h"

#include <QSignalBlocker>

namespace windfall::widgets {
namespace {

QStringList namesOf(const std::vector<model::Preset>& presets) {
  QStringList names{PresetField::tr("Default")};
  for (const model::Preset& preset : presets) names << preset.name;
  return names;
}

}  // namespace

PresetField::PresetField(const QString& domain, QWidget* parent)
    : PresetField(domain, model::PresetLibrary().of(domain), parent) {}

PresetField::PresetField(const QString& domain, std::vector<model::Preset> presets, QWidget* parent)
    : ChoiceField(tr("Preset"), namesOf(presets), 0, parent), domain_(domain), presets_(std::move(presets)) {}

void PresetField::reload() {
  presets_ = model::PresetLibrary().of(domain_);
  const QSignalBlocker quiet(box());
  box()->clear();
  box()->addItems(namesOf(presets_));
  setMixed();
}

}  // namespace windfall::widgets
