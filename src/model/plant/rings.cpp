#include "model/plant/rings.h"

#include <algorithm>
#include <cmath>

#include "kernels/random.h"
#include "model/plant/transport.h"

namespace windfall::model {

namespace {

constexpr float kPi = 3.14159265f;
constexpr float kTinyStep = 1e-6f;  ///< rings nearer than this fall together, m

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

/// Arc length at the start of each span, and of all.
std::vector<float> arcLengths(const ChainCurve& curve) {
  std::vector<float> along{0};
  for (const CurveSpan& span : curve.spans) along.push_back(along.back() + span.length(1));
  return along;
}

/// The place at an arc length.
struct Place {
  std::int32_t span = 0;
  float t = 0;
};

Place placeAt(const ChainCurve& curve, const std::vector<float>& along, float s) {
  const auto found = std::lower_bound(along.begin() + 1, along.end() - 1, s);
  const auto i = static_cast<std::size_t>(found - along.begin()) - 1;
  const float whole = along[i + 1] - along[i], rest = s - along[i];
  if (!(whole > 0) || rest >= whole) return {static_cast<std::int32_t>(i), 1};
  float t = std::clamp(rest / whole, 0.0f, 1.0f);
  for (int k = 0; k < 3; ++k) {
    const float speed = std::max(glm::length(curve.spans[i].derivative(t)), 0.1f * whole);
    t = std::clamp(t + (rest - curve.spans[i].length(t)) / speed, 0.0f, 1.0f);
  }
  return {static_cast<std::int32_t>(i), t};
}

/// Where a chain's seat and collar lie (4.1).
struct Seat {
  float exit = 0, collar = 0;  ///< m
  float base = 0;              ///< radius of the first ring, m
  float widening = 0;          ///< K
  float quarter(float x) const {
    if (!(collar > 0)) return 0;
    const float q = 1 - std::clamp((x - exit) / collar, 0.0f, 1.0f);
    return q * q;
  }
};

struct ChainBuild {
  std::vector<Ring> rings;
  RingChain info;
};

/// Factor of a trunk's radius at a height above its foot (3.2).
float flareAt(float s, float r0) { return std::exp(-std::max(s, 0.0f) / (1.5f * r0)); }

class Builder {
 public:
  Builder(const SkeletonGraph& graph, const Chains& chains, const std::vector<ChainCurve>& curves,
          const RingSettings& settings)
      : graph_(graph), chains_(chains), curves_(curves), settings_(settings), builds_(chains.chains.size()) {}

  RingSet run();

 private:
  void build(std::size_t c);
  std::vector<float> places(std::size_t c, const std::vector<float>& along, const Seat& seat, bool flares) const;
  void carryFrames(std::size_t c);
  Seat seatOf(std::size_t c, float length) const;
  bool flares(std::size_t c) const;

  const SkeletonGraph& graph_;
  const Chains& chains_;
  const std::vector<ChainCurve>& curves_;
  const RingSettings& settings_;
  std::vector<ChainBuild> builds_;
};

bool Builder::flares(std::size_t c) const {
  const Chain& chain = chains_.chains[c];
  const Segment& first = graph_.segments[chains_.links[chain.first]];
  return chain.parent < 0 && settings_.flare > 0 && first.kind == SegmentKind::Stem &&
         (first.state.wood < 0 || first.state.wood > 0.3f);
}

/// The ring at or below a pivot on its chain.
const Ring& ringBelow(const ChainBuild& build, const Pivot& pivot) {
  const auto later = std::partition_point(build.rings.begin() + 1, build.rings.end(), [&](const Ring& ring) {
    return ring.along <= 0 || ring.span < pivot.span || (ring.span == pivot.span && ring.t <= pivot.t);
  });
  return *(later - 1);
}

Seat Builder::seatOf(std::size_t c, float length) const {
  const Chain& chain = chains_.chains[c];
  const ChainCurve& curve = curves_[c];
  const Segment& first = graph_.segments[chains_.links[chain.first]];
  const CurveSpan& start = curve.spans.front();
  float within = curve.pivot.radius, outside = curve.pivot.radius;
  if (curve.pivot.span >= 0) {
    const ChainBuild& parent = builds_[at(chain.parent)];
    const Ring* below = &ringBelow(parent, curve.pivot);
    const Ring* above = below == &parent.rings.back() ? below : below + 1;
    // The thinner of what is drawn on either side, so that the seat stays inside whatever lies between.
    within = std::min(below->radius, above->radius);
    outside *= 1 + settings_.flare * below->flare;
  }
  const float sine = glm::length(glm::cross(start.tangent(0), curve.pivot.tangent));
  const float wood = first.state.wood < 0 ? 1 : first.state.wood;
  Seat seat;
  seat.exit = std::min(outside / std::max(sine, 0.2f), 0.8f * length);
  seat.collar = std::min(settings_.collarLength * start.r0, 0.3f * glm::length(first.b - first.a));
  seat.base = std::min(start.r0, settings_.seat * within);
  seat.widening = settings_.collar * (0.4f + 0.6f * wood);
  return seat;
}

std::vector<float> Builder::places(std::size_t c, const std::vector<float>& along, const Seat& seat,
                                   bool flares) const {
  std::vector<float> result(along.begin(), along.end()), extra;
  const float length = along.back();
  if (seat.base > 0) {
    extra = {0.6f * seat.exit, seat.exit, seat.exit + 0.5f * seat.collar, seat.exit + seat.collar};
  } else if (flares) {
    const float r0 = curves_[c].spans.front().r0;
    for (const float s : {0.4f, 0.9f, 1.5f, 2.3f, 3.3f, 4.8f}) extra.push_back(s * r0);
  }
  const float apart = seat.base > 0 ? 0.02f * seat.exit + kTinyStep : kTinyStep;
  for (const float s : extra) {
    const auto near = std::lower_bound(along.begin(), along.end(), s - apart);
    if (s > 0 && s < length - apart && (near == along.end() || *near > s + apart)) result.push_back(s);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

void Builder::build(std::size_t c) {
  const Chain& chain = chains_.chains[c];
  const ChainCurve& curve = curves_[c];
  ChainBuild& out = builds_[c];
  const std::vector<float> along = arcLengths(curve);
  Seat seat;
  const bool foot = flares(c);
  if (settings_.collars && chain.parent >= 0) {
    seat = seatOf(c, along.back());
  }
  out.info.exit = seat.exit;
  out.info.collarLength = seat.collar;
  out.info.length = along.back();
  out.info.u =
      chain.parent < 0 ? 0 : uniform(settings_.seed, 41, static_cast<std::uint32_t>(chains_.links[chain.first]));
  const float r0 = curve.spans.front().r0;
  for (const float s : places(c, along, seat, foot)) {
    const Place place = s > 0 ? placeAt(curve, along, s) : Place{0, 0};
    const CurveSpan& span = curve.spans[at(place.span)];
    Ring ring;
    ring.chain = static_cast<std::int32_t>(c);
    ring.span = place.span, ring.t = place.t;
    ring.position = span.point(place.t);
    ring.tangent = span.tangent(place.t);
    ring.radius = span.radius(place.t);
    ring.along = s;
    ring.own = ring.segment = span.segment;
    if (out.rings.empty() && chain.parent >= 0) ring.segment = chain.parentSegment;
    if (foot) {
      ring.flare = flareAt(s, r0);
      ring.radius *= 1 + settings_.flare * ring.flare;
    }
    if (seat.base > 0) {
      ring.collar = seat.quarter(s);
      ring.radius *= 1 + seat.widening * ring.collar;
      if (s < 0.6f * seat.exit) ring.radius = seat.base + (ring.radius - seat.base) * s / (0.6f * seat.exit);
    }
    if (foot && out.rings.empty()) {
      // The trunk goes on below the ground, so that no gap opens where it leans.
      Ring below = ring;
      below.position -= 2 * r0 * ring.tangent;
      below.along = -2 * r0;
      out.rings.push_back(below);
    }
    out.rings.push_back(ring);
  }
  out.rings.back().radius *= settings_.tipScale;
  carryFrames(c);
  const auto first = static_cast<std::uint32_t>(chains_.links[chain.first]);
  out.rings.front().v = chain.parent < 0 ? 0 : uniform(settings_.seed, 42, first);
  for (std::size_t i = 1; i < out.rings.size(); ++i) {
    const Ring& a = out.rings[i - 1];
    Ring& b = out.rings[i];
    if (a.along < 0) {
      b.v = a.v + barkRun(b.along - a.along, a.radius, b.radius, settings_.textureAspect);
      continue;
    }
    const RunningRadius law(curve.spans[at(b.span)], a.span == b.span ? a.t : 0, b.t, a.radius, b.radius);
    b.v = a.v + law.run(a.span == b.span ? a.t : 0, b.t).second / (2 * kPi * settings_.textureAspect);
  }
}

void Builder::carryFrames(std::size_t c) {
  using V = glm::dvec3;
  const Chain& chain = chains_.chains[c];
  const ChainCurve& curve = curves_[c];
  std::vector<Ring>& rings = builds_[c].rings;
  rings[0].normal = startNormal(rings[0].tangent, settings_.yaw);
  if (chain.parent >= 0 && curve.pivot.span >= 0) {
    const Ring& below = ringBelow(builds_[at(chain.parent)], curve.pivot);
    const V there = carriedAlong(V(below.position), V(below.tangent), V(below.normal), V(curve.pivot.point),
                                 V(curve.pivot.tangent));
    rings[0].normal = vec3(rotatedAlong(V(curve.pivot.tangent), V(rings[0].tangent), there));
  }
  // From joint to joint only: collar rings must not change what joints beyond them carry.
  V normal(rings[0].normal);
  std::size_t joint = 0;
  for (std::size_t i = 1; i < rings.size(); ++i) {
    const V carried = carriedAlong(V(rings[joint].position), V(rings[joint].tangent), normal, V(rings[i].position),
                                   V(rings[i].tangent));
    rings[i].normal = vec3(carried);
    if (rings[i].t >= 1 || rings[i].along <= 0) joint = i, normal = carried;
  }
}

RingSet Builder::run() {
  std::vector<std::vector<std::size_t>> orders;
  for (std::size_t c = 0; c < chains_.chains.size(); ++c) {
    const auto order = static_cast<std::size_t>(chains_.chains[c].order - 1);
    if (orders.size() <= order) orders.resize(order + 1);
    orders[order].push_back(c);
  }
  for (const std::vector<std::size_t>& order : orders) {
    const auto count = static_cast<std::int64_t>(order.size());
#pragma omp parallel for schedule(dynamic, 64) if (count > 64)
    for (std::int64_t i = 0; i < count; ++i) build(order[static_cast<std::size_t>(i)]);
  }
  for (std::size_t c = 0; c < chains_.chains.size(); ++c) {
    const Chain& chain = chains_.chains[c];
    if (chain.parent < 0 || curves_[c].pivot.span < 0) continue;
    const ChainBuild& parent = builds_[at(chain.parent)];
    const auto below = static_cast<std::size_t>(&ringBelow(parent, curves_[c].pivot) - parent.rings.data());
    builds_[at(chain.parent)].rings[below].kids += 1;
  }
  RingSet set;
  std::size_t total = 0;
  for (ChainBuild& build : builds_) {
    build.info.first = static_cast<std::uint32_t>(total);
    build.info.count = static_cast<std::uint32_t>(build.rings.size());
    set.chains.push_back(build.info);
    total += build.rings.size();
  }
  set.rings.reserve(total);
  for (const ChainBuild& build : builds_) set.rings.insert(set.rings.end(), build.rings.begin(), build.rings.end());
  return set;
}

}  // namespace

RunningRadius::RunningRadius(const CurveSpan& span, float t0, float t1, float r0, float r1)
    : span_(span),
      t0_(t0),
      t1_(t1),
      scale0_(r0 / std::max(span.radius(t0), 1e-9f)),
      scale1_(r1 / std::max(span.radius(t1), 1e-9f)) {}

float RunningRadius::at(float t) const {
  const float share = t1_ > t0_ ? (t - t0_) / (t1_ - t0_) : 0;
  return span_.radius(t) * (scale0_ * (1 - share) + scale1_ * share);
}

std::pair<float, float> RunningRadius::run(float from, float to) const {
  constexpr int kChords = 8;
  float arc = 0, run = 0;
  vec3 last = span_.point(from);
  for (int i = 1; i <= kChords; ++i) {
    const float t = from + (to - from) * static_cast<float>(i) / kChords;
    const vec3 next = span_.point(t);
    const float chord = glm::length(next - last);
    arc += chord;
    run += chord / std::max(at(t - 0.5f * (to - from) / kChords), 1e-6f);
    last = next;
  }
  return {arc, run};
}

float barkRun(float length, float r0, float r1, float aspect) {
  const float a = std::max(r0, 1e-6f), b = std::max(r1, 1e-6f);
  if (std::abs(a - b) < 1e-4f * a) return length / (2 * kPi * a * aspect);
  return length * std::log(a / b) / (2 * kPi * aspect * (a - b));
}

RingSet makeRings(const SkeletonGraph& graph, const Chains& chains, const std::vector<ChainCurve>& curves,
                  const RingSettings& settings) {
  return Builder(graph, chains, curves, settings).run();
}

std::vector<std::uint32_t> keptRings(const Ring* rings, std::uint32_t count, float tolerance, float collar) {
  std::vector<std::uint32_t> kept;
  if (count == 0) return kept;
  std::vector<char> keep(count, 0);
  keep[0] = keep[count - 1] = 1;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open{{0, count - 1}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    const Ring &from = rings[a], &to = rings[b];
    const vec3 chord = to.position - from.position;
    const float squared = glm::dot(chord, chord);
    float worst = tolerance;
    std::uint32_t split = 0;
    for (std::uint32_t i = a + 1; i < b; ++i) {
      const Ring& ring = rings[i];
      const float share =
          squared > 1e-20f ? std::clamp(glm::dot(ring.position - from.position, chord) / squared, 0.0f, 1.0f) : 0.0f;
      const float off = glm::length(ring.position - from.position - chord * share) +
                        std::abs(ring.radius - from.radius - (to.radius - from.radius) * share) +
                        collar * std::abs(ring.collar - from.collar - (to.collar - from.collar) * share);
      if (off > worst) worst = off, split = i;
    }
    if (split == 0) continue;
    keep[split] = 1;
    open.emplace_back(a, split);
    open.emplace_back(split, b);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    if (keep[i]) kept.push_back(i);
  }
  return kept;
}

}  // namespace windfall::model
