// Tangents for normal maps.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/math.h"

namespace windfall::model {

/// Of each vertex the direction in which u grows, at right angles to its unit normal, and in w the sign of the
/// bitangent, which points up the picture (glTF 2.0, 3.7.2.1). Triangles without area in the picture count nothing; a
/// vertex that has no others gets any direction at right angles.
std::vector<vec4> tangentsOf(std::span<const vec3> positions, std::span<const vec3> normals, std::span<const vec2> uvs,
                             std::span<const std::uint32_t> indices);

}  // namespace windfall::model
