// New plants from the growers' presets.
#pragma once

#include "model/plant/plant.h"
#include "model/presets/preset.h"
#include "sim/result.h"

namespace windfall::model {

/// A plant of a preset, full-grown, without leaves of the artist's own; names are compared without case.
Result<Plant> plantOfPreset(const PresetLibrary& library, const QString& name, quint64 seed);

/// Presets of plants that are grown by one of the growers, in the library's order.
std::vector<Preset> plantPresets(const PresetLibrary& library);

}  // namespace windfall::model
