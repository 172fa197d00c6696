#include "model/plant/surface.h"

#include <algorithm>
#include <cmath>

#include "kernels/noise.h"
#include "model/plant/surface_private.h"

namespace windfall::model {

namespace {

constexpr float kPi = 3.14159265f;

/// What all vertices of a chain share.
struct ChainLook {
  const Pivot* pivot = nullptr;  ///< null: a root, no junction
  float parentRadius = 0, blendLength = 0, blendEnd = 0;
  float u = 0;
  float baked = 0;  ///< whole repeats round the chain, 0: by the shader
  float bumps = 0;  ///< per m
};

struct Count {
  std::size_t vertices = 0, indices = 0;
};

Count countOf(const std::vector<MeshRing>& rings, const MeshSettings& settings) {
  Count count;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    count.vertices += rings[i].sides + 1;
    if (i > 0) count.indices += 3 * (rings[i - 1].sides + rings[i].sides);
  }
  count.vertices += 1;
  count.indices += 3 * rings.back().sides;
  if (settings.capBases) {
    count.vertices += 1;
    count.indices += 3 * rings.front().sides;
  }
  return count;
}

/// Rounded; a library's lround is slower than all the rest of a vertex.
std::uint8_t byteOf(float share) {
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): never negative
  return static_cast<std::uint8_t>(255 * std::clamp(share, 0.0f, 1.0f) + 0.5f);
}

/// Writes one chain into its place of the mesh.
class ChainWriter {
 public:
  ChainWriter(const FinalRings& chain, const ChainLook& look, const MeshSettings& settings, std::size_t firstVertex,
              std::size_t firstIndex, SurfaceMesh& mesh)
      : rings_(chain.rings),
        tip_(chain.tip),
        look_(look),
        settings_(settings),
        vertex_(static_cast<std::uint32_t>(firstVertex)),
        index_(firstIndex),
        mesh_(mesh) {}

  void write() {
    std::uint32_t before = 0;
    const std::uint32_t base = vertex_;
    for (std::size_t i = 0; i < rings_.size(); ++i) {
      const std::uint32_t first = vertex_;
      addRing(rings_[i]);
      if (i > 0) stitch(before, rings_[i - 1].sides, first, rings_[i].sides);
      before = first;
    }
    const MeshRing& top = rings_.back();
    const std::uint32_t tip = addPole(top, top.position + top.tangent * tip_, top.tangent);
    for (std::uint32_t k = 0; k < top.sides; ++k) triangle(before + k, before + k + 1, tip);
    if (!settings_.capBases) return;
    const std::uint32_t pole = addPole(rings_.front(), rings_.front().position, -rings_.front().tangent);
    for (std::uint32_t k = 0; k < rings_.front().sides; ++k) triangle(base + k + 1, base + k, pole);
  }

 private:
  /// Factor of the radius in a direction, from the roots' lobes.
  float lobe(const MeshRing& ring, float angle) const {
    return 1 + 0.15f * ring.flare * std::cos(settings_.lobes * angle + 0.7f);
  }

  float bump(vec3 place) const {
    const auto seed = static_cast<std::uint32_t>(settings_.seed);
    const vec3 p = place * look_.bumps;
    return noise4(seed, vec4(p, 0)).x + 0.5f * noise4(seed + 1, vec4(2.3f * p, 0)).x;
  }

  void addRing(const MeshRing& ring) {
    const vec3 binormal = glm::cross(ring.tangent, ring.normal);
    const auto sides = static_cast<float>(ring.sides);
    const float radius = ring.radius * (settings_.widthFactor ? widthFactor(sides) : 1.0f);
    for (std::uint32_t k = 0; k <= ring.sides; ++k) {
      const float share = static_cast<float>(k) / sides;
      // The seam closes to the bit.
      const float angle = k == ring.sides ? 0 : 2 * kPi * share;
      const float c = std::cos(angle), s = std::sin(angle);
      const vec3 out = ring.normal * c + binormal * s, around = binormal * c - ring.normal * s;
      float factor = 1;
      vec3 normal = out - ring.tangent * ring.slope;
      if (ring.flare > 0.01f && settings_.lobes > 0) {
        factor = lobe(ring, angle);
        normal -= around * ((lobe(ring, angle + 0.05f) - lobe(ring, angle - 0.05f)) / 0.1f);
      }
      if (settings_.gnarl > 0) {
        const vec3 place = ring.position + out * radius;
        const float h = 0.2f / look_.bumps, here = bump(place);
        factor += settings_.gnarl * here;
        const float across = bump(place + around * h) - here, along = bump(place + ring.tangent * h) - here;
        normal -= settings_.gnarl * radius / h * (around * across + ring.tangent * along);
      }
      const vec3 position = ring.position + out * (radius * factor);
      addVertex(ring, position, junctionNormal(ring, position, glm::normalize(normal)), share);
    }
  }

  /// Turned to the parent's surface where the chain comes out of it (4.1).
  vec3 junctionNormal(const MeshRing& ring, vec3 position, vec3 normal) const {
    if (look_.pivot == nullptr || !settings_.blendNormals || ring.along > look_.blendEnd) return normal;
    const vec3 axis = look_.pivot->tangent, off = position - look_.pivot->point;
    const vec3 radial = off - axis * glm::dot(off, axis);
    const float distance = glm::length(radial);
    if (!(distance > 1e-9f)) return normal;
    const float h = std::max(0.0f, distance - look_.parentRadius);
    const float w = 1 - std::clamp(h / look_.blendLength, 0.0f, 1.0f);
    const vec3 mixed = normal * (1 - w * w) + radial / distance * (w * w);
    const float length = glm::length(mixed);
    return length > 1e-3f ? mixed / length : normal;
  }

  std::uint32_t addVertex(const MeshRing& ring, vec3 position, vec3 normal, float share) {
    Vertex vertex{};
    vertex.position = position;
    vertex.normal = normal;
    vertex.bones = {ring.bones[0], ring.second > 0 ? ring.bones[1] : 0, 0, 0};
    vertex.weights = {1 - ring.second, ring.second, 0, 0};
    if (ring.second < 0.01f) vertex.bones[1] = 0, vertex.weights = {1, 0, 0, 0};
    if (ring.second > 0.99f) vertex.bones = {ring.bones[1], 0, 0, 0}, vertex.weights = {1, 0, 0, 0};
    const float dark = 1 - 0.35f * ring.collar;
    vertex.tint = {byteOf(dark), byteOf(dark), byteOf(dark), byteOf(ring.wood)};
    if (look_.baked > 0) {
      vertex.uv = {look_.baked * share + look_.u, -look_.baked * ring.v};
    } else {
      const float tile = settings_.tile * (1 + 2 * ring.wood) / 3;
      vertex.uv = {share + look_.u, -ring.v};
      vertex.repeats = std::max(0.0f, std::log2(2 * kPi * ring.radius / tile));
    }
    mesh_.vertices[vertex_] = vertex;
    return vertex_++;
  }

  std::uint32_t addPole(const MeshRing& ring, vec3 position, vec3 normal) {
    return addVertex(ring, position, normal, 0.5f);
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.indices[index_++] = a, mesh_.indices[index_++] = b, mesh_.indices[index_++] = c;
  }

  /// Whole steps in integers: the ring whose next corner comes first goes on (3.2).
  void stitch(std::uint32_t a, std::uint32_t sidesA, std::uint32_t b, std::uint32_t sidesB) {
    std::uint32_t x = 0, y = 0;
    while (x < sidesA || y < sidesB) {
      if (x < sidesA && (y == sidesB || (x + 1) * sidesB <= (y + 1) * sidesA)) {
        triangle(a + x, a + x + 1, b + y);
        ++x;
      } else {
        triangle(a + x, b + y + 1, b + y);
        ++y;
      }
    }
  }

  const std::vector<MeshRing>& rings_;
  float tip_;
  const ChainLook& look_;
  const MeshSettings& settings_;
  std::uint32_t vertex_;
  std::size_t index_;
  SurfaceMesh& mesh_;
};

ChainLook lookOf(const Chain& chain, const ChainCurve& curve, const RingChain& info, const std::vector<MeshRing>& rings,
                 const MeshSettings& settings) {
  ChainLook look;
  const float r0 = curve.spans.front().r0;
  if (chain.parent >= 0 && info.exit > 0) {
    look.pivot = &curve.pivot;
    look.parentRadius = curve.pivot.radius;
    look.blendLength = std::max(info.collarLength, 0.3f * r0);
    look.blendEnd = info.exit + look.blendLength + 4 * r0;
  }
  look.u = info.u;
  look.bumps = 1 / std::max(2.5f * r0, 0.01f);
  if (settings.bakeRepeats) {
    float sum = 0, wood = 0;
    for (const MeshRing& ring : rings) sum += ring.radius, wood += ring.wood;
    const auto count = static_cast<float>(rings.size());
    const float tile = settings.tile * (1 + 2 * wood / count) / 3;
    look.baked = std::max(1.0f, std::round(2 * kPi * sum / count / tile));
  }
  return look;
}

}  // namespace

SurfaceMesh meshRings(const SkeletonGraph& graph, const Chains& chains, const std::vector<ChainCurve>& curves,
                      const RingSet& set, const MeshSettings& settings) {
  const auto count = static_cast<std::int64_t>(set.chains.size());
  std::vector<FinalRings> rings(set.chains.size());
#pragma omp parallel for schedule(dynamic, 64) if (count > 64)
  for (std::int64_t c = 0; c < count; ++c) {
    const auto i = static_cast<std::size_t>(c);
    const RingChain& chain = set.chains[i];
    rings[i] = finalRings(graph, curves[i], set.rings.data() + chain.first, chain.count, chain, settings);
  }
  SurfaceMesh mesh;
  std::vector<std::size_t> firstVertex{0}, firstIndex{0};
  for (const FinalRings& chain : rings) {
    const Count size = countOf(chain.rings, settings);
    firstVertex.push_back(firstVertex.back() + size.vertices);
    firstIndex.push_back(firstIndex.back() + size.indices);
  }
  mesh.vertices.resize(firstVertex.back());
  mesh.indices.resize(firstIndex.back());
  mesh.firstIndex.assign(firstIndex.begin(), firstIndex.end());
#pragma omp parallel for schedule(dynamic, 64) if (count > 64)
  for (std::int64_t c = 0; c < count; ++c) {
    const auto i = static_cast<std::size_t>(c);
    const ChainLook look = lookOf(chains.chains[i], curves[i], set.chains[i], rings[i].rings, settings);
    ChainWriter(rings[i], look, settings, firstVertex[i], firstIndex[i], mesh).write();
  }
  return mesh;
}

}  // namespace windfall::model
