#include "model/plant/curves.h"

#include <algorithm>
#include <cmath>

namespace windfall::model {

namespace {

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

/// New organs are micrometres thick; nothing is drawn thinner than this.
constexpr float kThinnest = 1e-5f;
/// Of the last radius, where the source gives one radius an organ.
constexpr float kTipShare = 0.6f;

/// What a curve goes through: joint i ends segment `segment[i]`.
struct Joints {
  std::vector<vec3> points;
  std::vector<float> radii;
  std::vector<std::int32_t> segment;
  std::vector<float> share;
};

Pivot pivotOf(const SkeletonGraph& graph, const Chains& chains, const Chain& chain,
              const std::vector<ChainCurve>& curves) {
  const Segment& first = graph.segments[chains.links[chain.first]];
  Pivot pivot;
  pivot.point = first.a;
  pivot.radius = first.ra;
  const vec3 along = first.b - first.a;
  if (glm::length(along) > 0) pivot.tangent = glm::normalize(along);
  if (chain.parent < 0) return pivot;
  const std::vector<CurveSpan>& spans = curves[at(chain.parent)].spans;
  // A segment's spans stand at its place in the chain or one or two after it.
  for (std::size_t i = chains.place[at(chain.parentSegment)]; i < spans.size(); ++i) {
    const bool last = i + 1 == spans.size() || spans[i + 1].segment != chain.parentSegment;
    if (spans[i].segment != chain.parentSegment || (first.attach > spans[i].share1 + 1e-6f && !last)) continue;
    const float run = spans[i].share1 - spans[i].share0;
    pivot.span = static_cast<std::int32_t>(i);
    pivot.t = run > 0 ? std::clamp((first.attach - spans[i].share0) / run, 0.0f, 1.0f) : 1.0f;
    pivot.point = spans[i].point(pivot.t);
    pivot.tangent = spans[i].tangent(pivot.t);
    pivot.radius = spans[i].radius(pivot.t);
    break;
  }
  return pivot;
}

Joints jointsOf(const SkeletonGraph& graph, const Chains& chains, const Chain& chain, const Pivot& pivot) {
  Joints joints;
  const auto add = [&](vec3 point, float radius, std::int32_t segment, float share) {
    joints.points.push_back(point);
    joints.radii.push_back(std::max(radius, kThinnest));
    joints.segment.push_back(segment);
    joints.share.push_back(share);
  };
  const auto link = [&](std::uint32_t i) -> const Segment& { return graph.segments[chains.links[chain.first + i]]; };
  const auto first = static_cast<std::int32_t>(chains.links[chain.first]);
  add(pivot.point, link(0).ra, first, 0);
  // A head well beside its parent's axis is a joint of its own: the source had a curve there. Not where the way to it
  // leads backwards: that would be a hairpin inside the parent.
  const vec3 aside = link(0).a - pivot.point, along = link(0).b - link(0).a;
  const float way = glm::length(aside);
  if (chain.parent >= 0 && way > std::max(0.5f * pivot.radius, 1e-4f) &&
      glm::dot(aside, along) > 0.3f * way * glm::length(along)) {
    add(link(0).a, link(0).ra, first, 0);
  }
  for (std::uint32_t i = 0; i < chain.count; ++i) {
    const Segment& s = link(i);
    const bool last = i + 1 == chain.count;
    const float tip = s.rb < s.ra ? s.rb : kTipShare * s.rb;
    add(s.b, last ? tip : 0.5f * (s.rb + link(i + 1).ra), static_cast<std::int32_t>(chains.links[chain.first + i]), 1);
  }
  return joints;
}

/// Spans between joints whose derivatives by a common parameter and steps are known.
void addSpans(const Joints& joints, const std::vector<vec3>& v, const std::vector<float>& d,
              const std::vector<float>& slopes, std::vector<CurveSpan>& spans) {
  for (std::size_t i = 0; i + 1 < joints.points.size(); ++i) {
    CurveSpan span;
    span.p0 = joints.points[i], span.p1 = joints.points[i + 1];
    span.m0 = v[i] * d[i], span.m1 = v[i + 1] * d[i];
    const float chord = glm::length(span.p1 - span.p0);
    span.r0 = joints.radii[i], span.r1 = joints.radii[i + 1];
    span.d0 = slopes[i] * chord, span.d1 = slopes[i + 1] * chord;
    span.segment = joints.segment[i + 1];
    // From a pivot to a head beside it no share of the segment passes.
    span.share0 = joints.segment[i] == span.segment ? joints.share[i] : 0;
    span.share1 = joints.share[i + 1];
    spans.push_back(span);
  }
}

void makeHermite(const Joints& joints, std::vector<CurveSpan>& spans) {
  const std::vector<vec3>& p = joints.points;
  const std::size_t count = p.size();
  std::vector<float> d(count - 1), h(count - 1);
  for (std::size_t i = 0; i + 1 < count; ++i) {
    h[i] = glm::length(p[i + 1] - p[i]);
    d[i] = std::max(std::sqrt(h[i]), 1e-6f);
  }
  const auto chord = [&](std::size_t i) { return (p[i + 1] - p[i]) / d[i]; };
  const auto blend = [&](std::size_t i) { return (d[i] * chord(i - 1) + d[i - 1] * chord(i)) / (d[i - 1] + d[i]); };
  std::vector<vec3> v(count);
  for (std::size_t i = 1; i + 1 < count; ++i) v[i] = blend(i);
  if (count == 2) {
    v[0] = v[1] = chord(0);
  } else {
    v[0] = 1.5f * chord(0) - 0.5f * v[1];
    v[count - 1] = 1.5f * chord(count - 2) - 0.5f * v[count - 2];
  }
  addSpans(joints, v, d, monotoneSlopes(joints.radii, h), spans);
}

/// Cubic B-spline with the joints as controls and its ends tripled, so that it starts and ends on them.
void makeBSpline(const Joints& joints, std::vector<CurveSpan>& spans) {
  const auto count = static_cast<std::int64_t>(joints.points.size());
  const auto clampIndex = [&](std::int64_t i) {
    return static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, count - 1));
  };
  // Knots run one beyond either end.
  Joints knots;
  std::vector<vec3> v;
  std::vector<float> h;
  for (std::int64_t i = -1; i <= count; ++i) {
    const std::size_t a = clampIndex(i - 1), b = clampIndex(i), c = clampIndex(i + 1);
    knots.points.push_back((joints.points[a] + 4.0f * joints.points[b] + joints.points[c]) / 6.0f);
    knots.radii.push_back((joints.radii[a] + 4 * joints.radii[b] + joints.radii[c]) / 6);
    v.push_back(0.5f * (joints.points[c] - joints.points[a]));
    knots.segment.push_back(joints.segment[b]);
    knots.share.push_back(joints.share[b]);
    if (i == 0) knots.segment.back() = joints.segment[clampIndex(1)], knots.share.back() = 1.0f / 6;
    if (i == count - 1) knots.share.back() = 5.0f / 6;
  }
  for (std::size_t i = 0; i + 1 < knots.points.size(); ++i) {
    h.push_back(glm::length(knots.points[i + 1] - knots.points[i]));
  }
  addSpans(knots, v, std::vector<float>(h.size(), 1.0f), monotoneSlopes(knots.radii, h), spans);
  for (CurveSpan& span : spans) span.share1 = std::max(span.share1, span.share0);
}

}  // namespace

vec3 CurveSpan::point(float t) const {
  // The ends to the bit: they are shared with the neighbours.
  if (t <= 0) return p0;
  if (t >= 1) return p1;
  const float t2 = t * t, t3 = t2 * t;
  return p0 * (2 * t3 - 3 * t2 + 1) + m0 * (t3 - 2 * t2 + t) + p1 * (3 * t2 - 2 * t3) + m1 * (t3 - t2);
}

vec3 CurveSpan::derivative(float t) const {
  const float t2 = t * t;
  return (p0 - p1) * (6 * t2 - 6 * t) + m0 * (3 * t2 - 4 * t + 1) + m1 * (3 * t2 - 2 * t);
}

vec3 CurveSpan::tangent(float t) const {
  const vec3 d = derivative(std::clamp(t, 0.0f, 1.0f));
  const float length = glm::length(d);
  if (length > 1e-12f) return d / length;
  const vec3 chord = p1 - p0;
  const float straight = glm::length(chord);
  return straight > 1e-12f ? chord / straight : vec3(0, 1, 0);
}

float CurveSpan::radius(float t) const {
  if (t <= 0) return r0;
  if (t >= 1) return r1;
  const float t2 = t * t, t3 = t2 * t;
  const float r = r0 * (2 * t3 - 3 * t2 + 1) + d0 * (t3 - 2 * t2 + t) + r1 * (3 * t2 - 2 * t3) + d1 * (t3 - t2);
  return std::clamp(r, std::min(r0, r1), std::max(r0, r1));
}

float CurveSpan::length(float t) const {
  constexpr float kNodes[5] = {-0.9061798459f, -0.5384693101f, 0, 0.5384693101f, 0.9061798459f};
  constexpr float kWeights[5] = {0.2369268851f, 0.4786286705f, 0.5688888889f, 0.4786286705f, 0.2369268851f};
  float sum = 0;
  for (int i = 0; i < 5; ++i) sum += kWeights[i] * glm::length(derivative(0.5f * t * (1 + kNodes[i])));
  return 0.5f * t * sum;
}

std::vector<float> monotoneSlopes(const std::vector<float>& r, const std::vector<float>& h) {
  const std::size_t steps = h.size();
  std::vector<float> slope(steps), result(steps + 1, 0);
  for (std::size_t i = 0; i < steps; ++i) slope[i] = h[i] > 1e-12f ? (r[i + 1] - r[i]) / h[i] : 0;
  if (steps == 0) return result;
  result.front() = slope.front();
  result.back() = slope.back();
  for (std::size_t i = 1; i < steps; ++i) {
    const float before = slope[i - 1], after = slope[i];
    if (before * after <= 0) continue;
    const float w1 = 2 * h[i] + h[i - 1], w2 = h[i] + 2 * h[i - 1];
    result[i] = (w1 + w2) / (w1 / before + w2 / after);
  }
  return result;
}

std::vector<ChainCurve> makeCurves(const SkeletonGraph& graph, const Chains& chains, CurveKind kind) {
  std::vector<ChainCurve> curves(chains.chains.size());
  // A chain needs its parent's curve alone, so chains of one order are independent.
  std::vector<std::vector<std::int32_t>> orders;
  for (std::size_t c = 0; c < chains.chains.size(); ++c) {
    const auto order = static_cast<std::size_t>(chains.chains[c].order - 1);
    if (orders.size() <= order) orders.resize(order + 1);
    orders[order].push_back(static_cast<std::int32_t>(c));
  }
  for (const std::vector<std::int32_t>& order : orders) {
    const auto count = static_cast<std::int64_t>(order.size());
#pragma omp parallel for schedule(dynamic, 64) if (count > 64)
    for (std::int64_t i = 0; i < count; ++i) {
      const auto c = at(order[static_cast<std::size_t>(i)]);
      const Chain& chain = chains.chains[c];
      ChainCurve& curve = curves[c];
      curve.pivot = pivotOf(graph, chains, chain, curves);
      const Joints joints = jointsOf(graph, chains, chain, curve.pivot);
      if (kind == CurveKind::BSpline && joints.points.size() > 2) {
        makeBSpline(joints, curve.spans);
      } else {
        makeHermite(joints, curve.spans);
      }
    }
  }
  return curves;
}

}  // namespace windfall::model
