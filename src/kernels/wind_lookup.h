// windAt() with the four components of a node side by side in one register: the same bits in half the time. For the
// links, whose solvers would else wait for it longer than they work.
#pragma once

#include "kernels/wind.h"

namespace windfall {

#if defined(__GNUC__) && !defined(__CUDACC__)
using NodeValue = float __attribute__((vector_size(16)));
WINDFALL_HD NodeValue nodeValue(const vec4& node) {
  NodeValue value;
  __builtin_memcpy(&value, &node, sizeof value);
  return value;
}
WINDFALL_HD vec4 nodeOf(const NodeValue& value) { return {value[0], value[1], value[2], value[3]}; }
#else
using NodeValue = vec4;
WINDFALL_HD NodeValue nodeValue(const vec4& node) { return node; }
WINDFALL_HD vec4 nodeOf(const NodeValue& value) { return value; }
#endif

/// Where the corners of a cell lie behind a first node, and where in the cell one is.
struct CellPlace {
  std::int32_t x0, x1, y0, y1, z0, z1;
  float fx, fy, fz;
};

WINDFALL_HD vec4 trilinear(const vec4* nodes, const CellPlace& c) {
  const float gx = 1 - c.fx, gy = 1 - c.fy, gz = 1 - c.fz;
  const auto row = [&](std::int32_t at) {
    return nodeValue(nodes[at + c.x0]) * gx + nodeValue(nodes[at + c.x1]) * c.fx;
  };
  const NodeValue a = row(c.z0 + c.y0) * gy + row(c.z0 + c.y1) * c.fy;
  const NodeValue b = row(c.z1 + c.y0) * gy + row(c.z1 + c.y1) * c.fy;
  return nodeOf(a * gz + b * c.fz);
}

/// eddyAt().
WINDFALL_HD vec3 tileAt(const vec4* tile, const vec3& p) {
  const auto sane = [](float v) { return std::fabs(v) < 1e6f ? v : 0.f; };
  const float x = sane(p.x), y = sane(p.y), z = sane(p.z);
  const float bx = std::floor(x), by = std::floor(y), bz = std::floor(z);
  constexpr int kSlice = kTileX * kTileY;
  CellPlace c{};
  c.x0 = static_cast<int>(bx) & (kTileX - 1);
  c.x1 = (c.x0 + 1) & (kTileX - 1);
  c.y0 = (static_cast<int>(by) & (kTileY - 1)) * kTileX;
  c.y1 = (c.y0 + kTileX) & (kSlice - 1);
  c.z0 = (static_cast<int>(bz) & (kTileZ - 1)) * kSlice;
  c.z1 = (c.z0 + kSlice) & (kTileZ * kSlice - 1);
  c.fx = x - bx;
  c.fy = y - by;
  c.fz = z - bz;
  return vec3(trilinear(tile, c));
}

/// windAt(), m/s.
WINDFALL_HD vec3 airAt(const WindView& wind, const vec3& place) {
  if (wind.velocity == nullptr) return vec3(0);
  const vec3 p = (place - wind.origin) * wind.perMetre;
  // Not a number ends at 0.
  const auto within = [](float value, int count) {
    const float last = static_cast<float>(count - 1);
    const float above = value > 0 ? value : 0.f;
    return above < last ? above : last;
  };
  const float x = within(p.x, wind.nx), y = within(p.y, wind.ny), z = within(p.z, wind.nz);
  const int ix = static_cast<int>(x), iy = static_cast<int>(y), iz = static_cast<int>(z);
  CellPlace c{};
  c.x1 = ix + 1 < wind.nx ? 1 : 0;
  c.y1 = iy + 1 < wind.ny ? wind.nx : 0;
  c.z1 = iz + 1 < wind.nz ? wind.nx * wind.ny : 0;
  c.fx = x - static_cast<float>(ix);
  c.fy = y - static_cast<float>(iy);
  c.fz = z - static_cast<float>(iz);
  const vec4 node = trilinear(wind.velocity + (static_cast<std::int64_t>(iz) * wind.ny + iy) * wind.nx + ix, c);
  vec3 velocity(node);
  if (wind.eddies != nullptr && node.w > 0) {
    const vec3 eddy = tileAt(wind.eddies, place * wind.eddiesPerMetre - wind.eddyScroll);
    // Eddies cannot blow through the ground.
    const float height = place.y > 0 ? place.y : 0;
    velocity += node.w * vec3(eddy.x, 0.6f * height / (height + 1) * eddy.y, eddy.z);
  }
  for (int i = 0; i < wind.fanCount; ++i) velocity += jetAt(wind.fans[i], wind.eddies, wind.eddiesPerMetre, place);
  return velocity;
}

}  // namespace windfall
