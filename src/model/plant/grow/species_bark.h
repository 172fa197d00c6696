// Bark of a species: a tile that repeats, and the colour of its twigs.
#pragma once

#include <QImage>

#include "kernels/math.h"
#include "model/plant/grow/settings.h"

namespace windfall::model::growth {

/// A tile of bark that repeats in both directions, 0.45 m wide and 0.9 m tall; sRGB, RGBA8888.
QImage speciesBark(BarkLook look, quint64 seed);

/// What is thinner than bark: colour (linear) of the twigs, and below which radius they begin, m.
struct TwigLook {
  vec4 colour{0.1f, 0.07f, 0.05f, 1};
  float thinner = 0.008f;
};
TwigLook twigLook(BarkLook look);

}  // namespace windfall::model::growth
