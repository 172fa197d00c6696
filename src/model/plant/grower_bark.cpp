#include <algorithm>
#include <cmath>

#include "model/plant/grower_private.h"

namespace windfall::model::grower {

namespace {

constexpr float kPi = 3.14159265f;

/// A ring of the tube before it becomes vertices.
struct Ring {
  vec3 centre{0}, tangent{0, 1, 0}, normal{1, 0, 0};
  float radius = 0, along = 0;  ///< m
  float flare = 0;              ///< 0..1 of the root's lobes
  std::array<std::uint32_t, 2> bones{};
  float second = 0;  ///< weight of bones[1]
};

/// Carries the normal by double reflection (Wang et al. 2008; plant_meshing.md, 2.2).
vec3 carried(const Ring& from, const Ring& to) {
  const vec3 v1 = to.centre - from.centre;
  const float c1 = glm::dot(v1, v1);
  vec3 n = from.normal;
  if (c1 > 1e-20f) {
    const vec3 nl = n - 2 / c1 * glm::dot(v1, n) * v1;
    const vec3 tl = from.tangent - 2 / c1 * glm::dot(v1, from.tangent) * v1;
    const vec3 v2 = to.tangent - tl;
    const float c2 = glm::dot(v2, v2);
    n = c2 > 1e-20f ? nl - 2 / c2 * glm::dot(v2, nl) * v2 : nl;
  }
  return glm::normalize(n - to.tangent * glm::dot(n, to.tangent));
}

/// Weights of a ring at a share of a link: its bone alone in the middle, half and half at the joints.
void bind(Ring& ring, const Axis& axis, const std::vector<Axis>& axes, std::size_t link, float share) {
  constexpr float kBlend = 0.35f;
  const auto own = static_cast<std::uint32_t>(axis.firstBone) + static_cast<std::uint32_t>(link);
  ring.bones = {own, own};
  if (share < kBlend) {
    const float weight = 0.5f * (1 - share / kBlend);
    if (link > 0) {
      ring.bones[1] = own - 1, ring.second = weight;
    } else if (axis.parent >= 0) {
      const Axis& parent = axes[static_cast<std::size_t>(axis.parent)];
      ring.bones[1] = static_cast<std::uint32_t>(parent.firstBone + axis.parentLink);
      ring.second = weight;
    }
  } else if (share > 1 - kBlend && link + 2 < axis.nodes.size()) {
    ring.bones[1] = own + 1, ring.second = 0.5f * (share - 1 + kBlend) / kBlend;
  }
}

std::vector<Ring> ringsOf(const Axis& axis, const std::vector<Axis>& axes) {
  const std::size_t links = axis.nodes.size() - 1;
  const int perLink = axis.order == 0 ? 4 : axis.order == 1 ? 3 : 2;
  const float r0 = axis.radii[0];
  const float collar =
      axis.parent < 0 ? 0
                      : axes[static_cast<std::size_t>(axis.parent)].radii[static_cast<std::size_t>(axis.parentLink)];
  std::vector<Ring> rings;
  if (axis.parent < 0) {
    // The trunk goes on below the ground, so that no gap opens where it leans.
    Ring below;
    below.centre = axis.nodes[0] - vec3(0, 2 * r0, 0);
    below.radius = r0 * 1.5f;
    below.along = -2 * r0;
    below.flare = 1;
    bind(below, axis, axes, 0, 0);
    rings.push_back(below);
  }
  float along = 0;
  for (std::size_t link = 0; link < links; ++link) {
    std::vector<float> shares;
    // More rings where the root flares and where a limb leaves the trunk.
    if (link == 0) {
      const float length = glm::length(axis.nodes[1] - axis.nodes[0]);
      if (axis.parent < 0) {
        for (const float s : {0.0f, 0.8f, 1.7f, 3.0f, 4.5f}) {
          if (s * r0 < 0.95f * length) shares.push_back(s * r0 / length);
        }
      } else {
        shares = {0};
        for (const float s : {0.9f, 1.5f}) {
          if (s * collar < 0.45f * length) shares.push_back(s * collar / length);
        }
      }
    }
    for (int k = 0; k < perLink; ++k) {
      const float share = static_cast<float>(k) / static_cast<float>(perLink);
      if (shares.empty() || share > shares.back() + 0.05f) shares.push_back(share);
    }
    if (link + 1 == links) shares.push_back(1);
    for (const float share : shares) {
      Ring ring;
      ring.centre = curvePoint(axis, link, share);
      ring.tangent = curveTangent(axis, link, share);
      ring.radius = axis.radii[link] + (axis.radii[link + 1] - axis.radii[link]) * share;
      if (!rings.empty()) along += glm::length(ring.centre - rings.back().centre);
      if (rings.size() == 1 && axis.parent < 0) along = 0;
      ring.along = along;
      if (axis.parent < 0) {
        ring.flare = std::exp(-along / (2.0f * r0));
        ring.radius *= 1 + 0.5f * ring.flare;
      } else {
        // A collar: the side branch widens towards the bark that it comes from, never beyond it.
        const float widened = ring.radius * (1 + 0.7f * std::exp(-along / (0.9f * collar)));
        ring.radius = std::max(ring.radius, std::min(widened, 0.8f * collar));
      }
      bind(ring, axis, axes, link, share);
      rings.push_back(ring);
    }
  }
  const vec3 t = rings[0].tangent;
  const vec3 side = std::abs(t.z) > 0.9f ? vec3(1, 0, 0) : vec3(0, 0, 1);
  rings[0].normal = glm::normalize(side - t * glm::dot(t, side));
  for (std::size_t i = 1; i < rings.size(); ++i) rings[i].normal = carried(rings[i - 1], rings[i]);
  return rings;
}

Vertex vertexOf(const Ring& ring, vec3 position, vec3 normal, vec2 uv) {
  Vertex vertex{};
  vertex.position = position;
  vertex.normal = normal;
  vertex.uv = uv;
  vertex.bones = {ring.bones[0], ring.second > 0 ? ring.bones[1] : 0u, 0, 0};
  vertex.weights = {1 - ring.second, ring.second, 0, 0};
  return vertex;
}

void addTube(const std::vector<Ring>& rings, int sides, PlantGeometry& geometry) {
  const auto first = static_cast<std::uint32_t>(geometry.vertices.size());
  const auto across = static_cast<std::uint32_t>(sides) + 1;
  const float r0 = rings[rings.size() > 4 && rings[0].along < 0 ? 4 : 0].radius;
  const float repeats = std::max(1.0f, std::round(2 * kPi * r0 / 0.45f));
  const float perMetre = 0.5f * repeats / (2 * kPi * r0);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const Ring& ring = rings[i];
    const vec3 binormal = glm::cross(ring.tangent, ring.normal);
    const Ring& before = rings[i > 0 ? i - 1 : 0];
    const Ring& after = rings[i + 1 < rings.size() ? i + 1 : i];
    const float run = std::max(after.along - before.along, 1e-6f);
    const float slope = std::clamp((before.radius - after.radius) / run, -1.0f, 1.0f);
    for (std::uint32_t k = 0; k < across; ++k) {
      const float share = static_cast<float>(k) / static_cast<float>(sides);
      // The seam closes to the bit.
      const float angle = k + 1 == across ? 0 : 2 * kPi * share;
      const vec3 out = ring.normal * std::cos(angle) + binormal * std::sin(angle);
      // Five roots spread at the foot.
      const float lobes = 1 + 0.13f * ring.flare * std::cos(5 * angle + 0.7f);
      const vec3 normal = glm::normalize(out + ring.tangent * slope);
      geometry.vertices.push_back(
          vertexOf(ring, ring.centre + out * ring.radius * lobes, normal, {repeats * share, -ring.along * perMetre}));
    }
  }
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    geometry.indices.insert(geometry.indices.end(), {a, b, c});
  };
  for (std::uint32_t i = 0; i + 1 < rings.size(); ++i) {
    for (std::uint32_t k = 0; k + 1 < across; ++k) {
      const std::uint32_t a = first + i * across + k, b = a + across;
      triangle(a, a + 1, b);
      triangle(a + 1, b + 1, b);
    }
  }
  const Ring& bottom = rings.front();
  const Ring& top = rings.back();
  const auto end = static_cast<std::uint32_t>(geometry.vertices.size());
  geometry.vertices.push_back(vertexOf(bottom, bottom.centre, -bottom.tangent, {0, -bottom.along * perMetre}));
  geometry.vertices.push_back(vertexOf(top, top.centre + top.tangent * (0.8f * top.radius), top.tangent,
                                       {0.5f * repeats, -top.along * perMetre}));
  const std::uint32_t lastRing = first + static_cast<std::uint32_t>(rings.size() - 1) * across;
  for (std::uint32_t k = 0; k + 1 < across; ++k) {
    triangle(end, first + k + 1, first + k);
    triangle(end + 1, lastRing + k, lastRing + k + 1);
  }
}

}  // namespace

void buildBark(const std::vector<Axis>& axes, PlantGeometry& geometry) {
  for (const Axis& axis : axes) {
    const float radius = axis.radii[0];
    const int sides = radius > 0.05f ? 20 : radius > 0.02f ? 10 : radius > 0.008f ? 7 : 5;
    addTube(ringsOf(axis, axes), sides, geometry);
  }
}

}  // namespace windfall::model::grower
