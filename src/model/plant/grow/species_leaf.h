// The leaf that a species wears while the artist has hung none of their own on it.
#pragma once

#include "model/leaf/atlas.h"
#include "model/plant/grow/settings.h"

namespace windfall::model::growth {

/// Different leaves of one species that a tree chooses from.
inline constexpr int kLeafVariants = 2;

/// A painted leaf, or a twig full of needles for conifers, in summer's colours; petiole's end at the bottom, tip up.
/// `metres` is for a blade of `length` m. Blades have fitted meshes, needle twigs the whole picture's. The same
/// arguments give the same bits.
LeafTexture speciesLeaf(LeafLook look, int variant, double length);

/// The needle twigs: a card of code-drawn needles on a stalk, RGBA8888.
QImage needleTwig(bool pine, quint64 seed, int height);

}  // namespace windfall::model::growth
