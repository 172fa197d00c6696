// What changed in a document.
#pragma once

#include <QRect>

#include "model/ids.h"

namespace windfall::model {

enum class Aspect {
  Everything,  ///< another project was opened
  Assets,      ///< leaf or plant added, removed, renamed
  LeafPhoto,
  LeafMask,
  LeafRoot,
  LeafVeins,
  LeafMarkers,
  LeafParameters,
  LeafExamples,  ///< who lends colours, and which region to which
  LeafVariants,
  Atlas,  ///< how leaves are packed
  PlantSource,
  PlantEdits,
  PlantClips,
  PlantLeaves,
  SceneTrees,
  Wind,
  FallingLeaves,
  Solver,
  Light,
  Simulation,
  View,
};

/// `asset` is 0 where the whole scene is meant; `dirty` is the changed part of an image, empty: all of it.
struct Change {
  AssetId asset;
  Aspect aspect = Aspect::Everything;
  QRect dirty;
};

}  // namespace windfall::model
