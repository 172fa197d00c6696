// What an artist sets about a plant's surface; part of the plant.
#pragma once

#include "model/plant/chains.h"
#include "model/plant/curves.h"

namespace windfall::model {

enum class BarkKind { Oak, Birch, Beech, Pine, Maple, Herb };

struct SurfaceSettings {
  double scale = 1;           ///< on the whole plant
  bool fromSkeleton = false;  ///< meshes an imported plant anew instead of showing its own mesh
  ChainSettings chains;
  CurveKind curve = CurveKind::Hermite;
  double detail = 0.5;  ///< 0..1: tolerance of 4 mm to 0.05 mm
  BarkKind bark = BarkKind::Oak;
  double tile = 0.15;        ///< width of the bark's picture on the stem, m
  double flare = 0.4;        ///< widening at a trunk's foot, share of its radius
  int lobes = 5;             ///< roots that show there
  double gnarl = 0;          ///< bumps, share of the radius
  bool roots = true;         ///< shows roots under the ground, where the file has them
  bool followsState = true;  ///< green where there is no wood yet, drooping leaves where water is short
  bool bakeRepeats = false;  ///< for export: bark coordinates that need no shader; never saved
  bool operator==(const SurfaceSettings&) const = default;
};

}  // namespace windfall::model
