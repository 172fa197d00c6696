// Tertiary and finer veins: they grow towards sources of auxin in the tissue (Runions and others 2005).
#pragma once

#include <QImage>

#include "model/leaf/leaf.h"
#include "model/leaf/vein.h"

namespace windfall::model {

/// Orders of the finer veins, and up to which order veins part a blade into regions.
inline constexpr int kTertiaryOrder = 3, kMicroOrder = 4, kStructureOrder = 2;

/// Appends finer veins that grow from those there are until no tissue lies farther than about `parameters.microSpacing`
/// from a vein. Open: each source pulls its nearest vein. Closed: it pulls every vein in its relative neighbourhood and
/// joins them, which makes loops (leaf_textures.md, 3). All points lie on the mask. Photo pixels.
void growMicroVeins(const QImage& mask, const VeinParameters& parameters, Veins& veins);

}  // namespace windfall::model
