// Maps as pictures to be looked at.
#pragma once

#include <QImage>

#include "model/leaf/maps.h"

namespace windfall::model {

/// In the order of the window's list.
enum class MapKind { Lit, Colour, Normal, Height, Roughness, Translucency, Occlusion };

/// The map over the texture's own alpha; Lit: the texture under a low light from the upper left, with its relief, gloss
/// and occlusion.
QImage mapPicture(const QImage& texture, const LeafMaps& maps, MapKind kind);

}  // namespace windfall::model
