#include "widgets/viewport/detail_bench_tubes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "kernels/detail_select.h"

namespace windfall::widgets {

namespace {

constexpr float kTau = 6.28318531f;

/// A run between two rings, and the piece of its chain's curve that it follows; tips have none.
struct Run {
  const DetailRing &a, &b;
  const model::CurveSpan* span = nullptr;
  float t0 = 0, t1 = 1;
};

/// How much of the bark's run lies below a share of the way, for a radius that changes evenly (plant_meshing.md, 5).
float barkShare(float r0, float r1, float share) {
  const float thin = std::max(r1 / std::max(r0, 1e-9f), 1e-3f);
  return std::abs(thin - 1) < 1e-3f ? share : std::log(1 + share * (thin - 1)) / std::log(thin);
}

/// A ring on the run, its radius by the curve's own law.
DetailRing ringAt(const Run& run, float share) {
  DetailRing ring = run.a;
  const DetailRing& b = run.b;
  ring.position = glm::mix(run.a.position, b.position, share);
  ring.radius = glm::mix(run.a.radius, b.radius, share);
  ring.slope = glm::mix(run.a.slope, b.slope, share);
  if (run.span != nullptr) {
    const float t = run.t0 + (run.t1 - run.t0) * share;
    ring.position = run.span->point(t);
    ring.tangent = run.span->tangent(t);
    ring.radius = model::RunningRadius(*run.span, run.t0, run.t1, run.a.radius, b.radius).at(t);
  }
  const vec3 normal = glm::mix(run.a.normal, b.normal, share);
  ring.normal = glm::normalize(normal - ring.tangent * glm::dot(normal, ring.tangent));
  ring.v = glm::mix(run.a.v, b.v, barkShare(run.a.radius, b.radius, share));
  ring.outwards = glm::mix(run.a.outwards, b.outwards, share);
  ring.gap = glm::mix(run.a.gap, b.gap, share);
  ring.reach = glm::mix(run.a.reach, b.reach, share);
  ring.collar = glm::mix(run.a.collar, b.collar, share);
  return ring;
}

class Tubes {
 public:
  Tubes(const TubeSource& source, bool outline) : source_(source), outline_(outline) {}

  /// A tube for each run; `countsOf` gives its counts, none of it where there are no pieces.
  template <class CountsOf>
  render::Mesh make(const CountsOf& countsOf) {
    std::size_t first = 0;
    for (std::size_t c = 0; c < source_.rings.chains.size(); ++c) {
      const model::RingChain& chain = source_.rings.chains[c];
      const model::Ring* rings = source_.rings.rings.data() + chain.first;
      const DetailRing* seen = source_.detail.rings.data() + first;
      for (std::uint32_t i = 0; i + 1 < chain.count; ++i) {
        const model::Ring &from = rings[i], &to = rings[i + 1];
        const Run run{seen[i], seen[i + 1], &source_.curves[c].spans[static_cast<std::size_t>(to.span)],
                      from.span == to.span ? from.t : 0, to.t};
        add(run, countsOf(run));
      }
      for (std::uint32_t i = chain.count - 1; i < chain.count + 1; ++i) {
        const Run run{seen[i], seen[i + 1]};
        add(run, countsOf(run));
      }
      first += chain.count + 2;
    }
    return std::move(mesh_);
  }

 private:
  void add(const Run& run, const TubeCounts& counts) {
    if (counts.pieces == 0) return;
    // Runs of one chain with as many corners share a ring.
    const bool shared = &run.a == last_ && counts.sides == lastSides_;
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size()) - (shared ? counts.sides + 1 : 0);
    const float factor = outline_ ? detail::outlineFactor(static_cast<float>(counts.sides)) : 1;
    for (std::uint32_t i = shared ? 1 : 0; i <= counts.pieces; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(counts.pieces);
      const DetailRing ring = ringAt(run, t);
      const vec3 side = glm::cross(ring.tangent, ring.normal);
      for (std::uint32_t j = 0; j <= counts.sides; ++j) {
        const float share = static_cast<float>(j % counts.sides) / static_cast<float>(counts.sides);
        const vec3 radial = ring.normal * std::cos(kTau * share) + side * std::sin(kTau * share);
        render::Vertex vertex;
        vertex.position = ring.position + radial * (ring.radius * factor);
        vertex.normal = glm::normalize(radial - ring.tangent * ring.slope);
        const float height = ring.gap + std::max(ring.reach, 0.0f) * glm::dot(radial, ring.outwards);
        const float blend = 1 - std::clamp(height, 0.0f, 1.0f);
        vertex.normal = glm::normalize(glm::mix(vertex.normal, ring.outwards, blend * blend));
        vertex.uv = vec2(static_cast<float>(j) / static_cast<float>(counts.sides), -ring.v);
        vertex.links[0] = run.a.link, vertex.links[1] = run.b.link;
        vertex.weights[0] = 1 - t, vertex.weights[1] = t;
        const std::uint32_t tint = detail::shadedTint(ring.tint, ring.collar);
        for (std::uint32_t k = 0; k < 4; ++k) vertex.tint[k] = static_cast<std::uint8_t>(tint >> (8 * k));
        mesh_.vertices.push_back(vertex);
      }
    }
    last_ = &run.b, lastSides_ = counts.sides;
    const std::uint32_t row = counts.sides + 1;
    for (std::uint32_t i = 0; i < counts.pieces; ++i) {
      for (std::uint32_t j = 0; j < counts.sides; ++j) {
        const std::uint32_t a = first + i * row + j, b = a + row;
        for (const std::uint32_t index : {a, a + 1, b, a + 1, b + 1, b}) mesh_.indices.push_back(index);
      }
    }
  }

  const TubeSource& source_;
  bool outline_;
  const DetailRing* last_ = nullptr;
  std::uint32_t lastSides_ = 0;
  render::Mesh mesh_;
};

}  // namespace

render::Mesh uniformTubes(const TubeSource& source, std::uint32_t across, std::uint32_t along) {
  return Tubes(source, false).make([&](const Run& run) {
    const float share = run.span == nullptr ? 0 : run.t1 - run.t0;
    return TubeCounts{across, std::max(1u, static_cast<std::uint32_t>(std::lround(share * static_cast<float>(along))))};
  });
}

render::Mesh boundedTubes(const TubeSource& source, float tolerance) {
  return Tubes(source, true).make([&](const Run& run) {
    const float radius = std::max(run.a.radius, run.b.radius);
    // Tips too small to be seen are left out.
    if (run.span == nullptr && radius * 0.8f < tolerance) return TubeCounts{3, 0};
    const float share = std::clamp(1 - tolerance / std::max(radius, 1e-6f), -1.0f, 1.0f);
    const float sides = std::clamp(std::ceil(0.5f * kTau / std::acos(share)), 3.0f, 48.0f);
    const vec3 &t0 = run.a.tangent, &t1 = run.b.tangent;
    const float angle = std::atan2(glm::length(glm::cross(t0, t1)), glm::dot(t0, t1));
    const float sag = glm::distance(run.a.position, run.b.position) * angle / 8;
    const float pieces = std::clamp(std::ceil(std::sqrt(sag / tolerance)), 1.0f, 8.0f);
    return TubeCounts{static_cast<std::uint32_t>(sides), static_cast<std::uint32_t>(pieces)};
  });
}

}  // namespace windfall::widgets
