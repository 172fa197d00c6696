#include "model/plant/grow/plant_presets.h"

#include <algorithm>

namespace windfall::model {

std::vector<Preset> plantPresets(const PresetLibrary& library) {
  std::vector<Preset> all;
  for (Preset& preset : library.of(QStringLiteral("grower"))) {
    if (preset.values.value(QStringLiteral("method")).toInt() != 0) all.push_back(std::move(preset));
  }
  return all;
}

Result<Plant> plantOfPreset(const PresetLibrary& library, const QString& name, quint64 seed) {
  QStringList names;
  std::vector<Preset> all = library.of(QStringLiteral("grower"));
  // The artist's own stand last and go before built-in ones of the same name.
  std::reverse(all.begin(), all.end());
  for (const Preset& preset : all) {
    names.prepend(preset.name);
    if (preset.name.compare(name, Qt::CaseInsensitive) != 0) continue;
    Plant plant;
    plant.name = preset.name;
    GrowerSettings settings;
    if (const Status applied = applyPreset(preset, settings); !applied) return applied.error();
    settings.seed = seed;
    plant.grower = settings;
    return plant;
  }
  return Error{"there is no preset \"" + name.toStdString() + "\"; there are " +
               names.join(QStringLiteral(", ")).toStdString()};
}

}  // namespace windfall::model
