#include <algorithm>
#include <cmath>

#include "model/plant/surface_private.h"

namespace windfall::model {

namespace {

constexpr float kPi = 3.14159265f;
constexpr float kFewest = 3, kMost = 48;
constexpr float kMostPieces = 8, kMostSplits = 32;
constexpr float kTipHeight = 0.8f;   ///< of the last radius
constexpr float kEvenRatio = 0.04f;  ///< |ln| of a radius' change of 0.96

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

MeshRing meshRing(const SkeletonGraph& graph, const Ring& ring) {
  MeshRing out;
  out.position = ring.position, out.tangent = ring.tangent, out.normal = ring.normal;
  out.radius = ring.radius;
  out.v = ring.v, out.along = ring.along;
  out.bones[0] = out.bones[1] = static_cast<std::uint32_t>(ring.segment);
  out.flare = ring.flare, out.collar = ring.collar;
  const float wood = graph.segments[at(ring.own)].state.wood;
  out.wood = wood < 0 ? 1 : wood;
  return out;
}

/// Pieces between two rings: by the curve's sag, by what leaves between them, by the change of the radius.
std::uint32_t piecesBetween(const Ring& a, const Ring& b, bool onCurve, float exit, const MeshSettings& settings) {
  const float chord = glm::length(b.position - a.position);
  float pieces = 1;
  if (onCurve) {
    const float theta = std::atan2(glm::length(glm::cross(a.tangent, b.tangent)), glm::dot(a.tangent, b.tangent));
    const float sag = chord * theta / 8;
    pieces = std::sqrt(sag / settings.tolerance);
    if (settings.seats && a.kids > 0) pieces = std::max(pieces, std::sqrt(sag / (0.1f * std::min(a.radius, b.radius))));
    pieces = std::clamp(std::ceil(pieces), 1.0f, kMostPieces);
  }
  if (settings.evenBark && b.along > exit && std::max(a.radius, b.radius) >= settings.barkFrom) {
    const float change =
        std::abs(std::log(std::max(a.radius, settings.tolerance) / std::max(b.radius, settings.tolerance)));
    pieces = std::max(pieces, std::min(std::ceil(change / kEvenRatio), kMostSplits));
  }
  return static_cast<std::uint32_t>(pieces);
}

/// A ring between two others at a share of the way.
MeshRing between(const MeshRing& a, const MeshRing& b, const Ring& from, const Ring& to, const CurveSpan* span,
                 float share) {
  MeshRing ring = a;
  float arc = share, run = share;
  float radius = a.radius + (b.radius - a.radius) * share;
  if (span != nullptr) {
    const float t0 = from.span == to.span ? from.t : 0, t = t0 + (to.t - t0) * share;
    ring.position = span->point(t);
    ring.tangent = span->tangent(t);
    const RunningRadius law(*span, t0, to.t, a.radius, b.radius);
    radius = law.at(t);
    // A Hermite span does not run at one speed, nor does its radius change evenly.
    const auto [arcBelow, runBelow] = law.run(t0, t);
    const auto [arcAbove, runAbove] = law.run(t, to.t);
    arc = arcBelow / std::max(arcBelow + arcAbove, 1e-9f);
    run = runBelow / std::max(runBelow + runAbove, 1e-9f);
  } else {
    ring.position = a.position + (b.position - a.position) * share;
    ring.tangent = glm::normalize(a.tangent * (1 - share) + b.tangent * share);
  }
  ring.radius = radius;
  const vec3 normal = a.normal * (1 - share) + b.normal * share;
  ring.normal = glm::normalize(normal - ring.tangent * glm::dot(normal, ring.tangent));
  ring.along = a.along + (b.along - a.along) * arc;
  if (span == nullptr) {
    // The share of the bark's run that lies below: exact for a radius that runs linearly.
    run = std::clamp(share * barkRun(1, a.radius, radius, 1) / barkRun(1, a.radius, b.radius, 1), 0.0f, 1.0f);
  }
  ring.v = a.v + (b.v - a.v) * run;
  ring.bones[0] = a.bones[0], ring.bones[1] = b.bones[0];
  ring.second = a.bones[0] == b.bones[0] ? 0 : share;
  ring.flare = a.flare + (b.flare - a.flare) * share;
  ring.collar = a.collar + (b.collar - a.collar) * share;
  ring.wood = a.wood + (b.wood - a.wood) * share;
  return ring;
}

/// The discs of two rings cut each other: the curve bends more sharply than its tube is thick.
bool cross(const MeshRing& a, const MeshRing& b) {
  const vec3 d = b.position - a.position;
  const float distance = glm::length(d), radii = a.radius + b.radius;
  if (distance > radii) return false;
  const float ahead = std::min(glm::dot(d, a.tangent), glm::dot(d, b.tangent));
  return ahead <= 1.05f * std::max(a.radius, b.radius) * glm::length(b.tangent - a.tangent) + 1e-7f;
}

/// Leaves out rings that cut the one before; the first carries the seat and the last the tip, so those stay.
void dropCrossing(std::vector<MeshRing>& rings) {
  std::vector<MeshRing> kept;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const bool last = i + 1 == rings.size();
    if (!kept.empty() && !last && cross(kept.back(), rings[i])) continue;
    while (last && kept.size() > 1 && cross(kept.back(), rings[i])) kept.pop_back();
    kept.push_back(rings[i]);
  }
  rings = std::move(kept);
}

void addDome(FinalRings& chain, const MeshSettings& settings) {
  const MeshRing end = chain.rings.back();
  chain.tip = kTipHeight * end.radius;
  if (!settings.dome || end.sides <= 3 || end.radius <= 4 * settings.tolerance) return;
  for (const float x : {0.5f, 0.85f}) {
    MeshRing ring = end;
    const float height = kTipHeight * x * end.radius;
    ring.position += ring.tangent * height;
    ring.radius *= std::sqrt(1 - x * x);
    ring.along += height;
    ring.v += barkRun(height, end.radius, end.radius, 1);
    chain.rings.push_back(ring);
    chain.tip = kTipHeight * (1 - x) * end.radius;
  }
}

}  // namespace

std::uint32_t ringSides(float radius, float tolerance) {
  if (radius <= tolerance) return 3;
  return static_cast<std::uint32_t>(std::clamp(std::ceil(kPi / std::acos(1 - tolerance / radius)), kFewest, kMost));
}

float widthFactor(float sides) { return kPi / (sides * std::sin(kPi / sides)); }

float toleranceOf(double detail) { return static_cast<float>(0.004 * std::pow(0.0125, std::clamp(detail, 0.0, 1.0))); }

FinalRings finalRings(const SkeletonGraph& graph, const ChainCurve& curve, const Ring* rings, std::uint32_t count,
                      const RingChain& chain, const MeshSettings& settings) {
  std::vector<std::uint32_t> kept;
  if (settings.merge) {
    kept = keptRings(rings, count, settings.tolerance);
  } else {
    for (std::uint32_t i = 0; i < count; ++i) kept.push_back(i);
  }
  FinalRings out;
  std::vector<MeshRing>& result = out.rings;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const Ring& ring = rings[kept[i]];
    const MeshRing here = meshRing(graph, ring);
    if (i > 0) {
      const Ring& from = rings[kept[i - 1]];
      const MeshRing before = meshRing(graph, from);
      const bool onCurve = kept[i] == kept[i - 1] + 1 && from.along >= 0 &&
                           (from.span == ring.span || (from.span + 1 == ring.span && from.t >= 1));
      const CurveSpan* span = onCurve ? &curve.spans[at(ring.span)] : nullptr;
      const std::uint32_t pieces = piecesBetween(from, ring, onCurve, chain.exit, settings);
      for (std::uint32_t k = 1; k < pieces; ++k) {
        result.push_back(between(before, here, from, ring, span, static_cast<float>(k) / static_cast<float>(pieces)));
      }
    }
    result.push_back(here);
  }
  dropCrossing(result);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const MeshRing& before = result[i > 0 ? i - 1 : 0];
    const MeshRing& after = result[std::min(i + 1, result.size() - 1)];
    const float run = std::max(after.along - before.along, 1e-6f);
    result[i].slope = std::clamp((after.radius - before.radius) / run, -2.0f, 2.0f);
    result[i].sides = ringSides(result[i].radius, settings.tolerance);
    // Rings of other counts need room: on a narrow band their corners would make triangles that look along the axis.
    const bool narrow =
        i > 0 && glm::length(result[i].position - before.position) < 0.7f * std::max(result[i].radius, before.radius);
    if (narrow) result[i].sides = before.sides;
  }
  addDome(out, settings);
  return out;
}

}  // namespace windfall::model
