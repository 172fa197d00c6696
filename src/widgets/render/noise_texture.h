// Tileable noise, made once: everything procedural in the shaders reads it through mip levels, so nothing aliases.
#pragma once

#include "widgets/render/gl_object.h"

namespace windfall::render {

/// RGBA8, repeating, with mip levels. Red: five octaves of gradient noise from 4 waves a tile on; green: three octaves
/// from 32 waves on; blue: ridges, four octaves from 8 waves on; alpha: white noise.
Texture makeNoiseTexture();

}  // namespace windfall::render
