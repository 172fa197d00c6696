#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "model/leaf/leaf_mesh.h"

namespace windfall::model {

LeafBend bendOf(float dryness, float own, float stalk, float halfWidth) {
  LeafBend bend;
  // Fresh leaves droop towards the tip, dry ones curl up, most of them in a C.
  bend.curvature = (-0.45f + 2.75f * dryness) * (1 + 0.5f * own);
  bend.fold = (0.16f + 0.55f * dryness) * (1 - 0.25f * own);
  bend.roll = 0.10f + 0.70f * dryness * (1 + 0.3f * own);
  bend.stalk = stalk;
  bend.halfWidth = halfWidth;
  bend.ripple = 0.006f + 0.03f * dryness;
  return bend;
}

BentPoint bend(const LeafVertex& vertex, const LeafBend& bend) {
  const float curvature = std::abs(bend.curvature) < 1e-4f ? 1e-4f : bend.curvature;
  const float above = std::max(0.f, vertex.place.y - bend.stalk), angle = curvature * above;
  const vec3 out(0, -std::sin(angle), std::cos(angle));
  const vec3 rib = vec3(vertex.place.x - vertex.rib, std::min(vertex.place.y, bend.stalk) + std::sin(angle) / curvature,
                        (1 - std::cos(angle)) / curvature);
  // Across: straight up at the fold's angle, then on along an arc.
  const float turn = std::max(1e-4f, bend.roll / std::max(1e-3f, bend.halfWidth));
  const float side = vertex.rib < 0 ? -1.f : 1.f, far = std::abs(vertex.rib), slope = bend.fold + turn * far;
  const float across = (std::sin(slope) - std::sin(bend.fold)) / turn,
              up = (std::cos(bend.fold) - std::cos(slope)) / turn;
  BentPoint point;
  const float outer = std::min(1.f, far / std::max(1e-3f, bend.halfWidth));
  const float wave = bend.ripple * outer * outer * std::sin(21 * vertex.place.y + 2 * side);
  point.position = rib + vec3(side * across, 0, 0) + out * (up + wave);
  // The two halves meet in a groove, not in an edge.
  const float tilt = side * (slope - bend.fold * std::max(0.f, 1 - far / (0.12f * bend.halfWidth + 1e-4f)));
  point.normal = out * std::cos(tilt) - vec3(std::sin(tilt), 0, 0);
  return point;
}

}  // namespace windfall::model
