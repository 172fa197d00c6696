// Bark from rules, by species: pictures that repeat in both directions, with their relief.
#pragma once

#include "model/plant/geometry.h"
#include "model/plant/surface_settings.h"

namespace windfall::model {

/// Colour (sRGB) and normals of a tile; its width is `SurfaceSettings::tile`, its height the same.
struct BarkTile {
  QImage colour, normals;
};

/// Oak: deep fissures between long ridges. Birch: white, with dark lenticels across and black scars. Beech: smooth and
/// grey. Pine: large red-brown plates. Maple: shallow ridges and flakes. Herb: green skin with fine ribs. The same bits
/// for the same kind, seed and size; the picture is made once a program.
BarkTile barkTile(BarkKind kind, quint64 seed = 1, int size = 512);

/// The material of a stem's surface.
Material barkMaterial(BarkKind kind);

}  // namespace windfall::model
