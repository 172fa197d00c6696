#include "model/plant/chains.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace windfall::model {

namespace {

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

/// 0 where either is too short to have a direction.
double cosineOfTurn(const Segment& parent, const Segment& child) {
  const vec3 u = parent.b - parent.a, v = child.b - child.a;
  const double lu = static_cast<double>(glm::length(u)), lv = static_cast<double>(glm::length(v));
  if (lu < 1e-6 || lv < 1e-6) return 1;
  return static_cast<double>(glm::dot(u, v)) / (lu * lv);
}

/// Strahler order and longest way to a tip, tips first.
void measure(const SkeletonGraph& graph, Chains& chains) {
  const std::size_t count = graph.segments.size();
  chains.strahler.assign(count, 0);
  chains.reach.assign(count, 0);
  std::vector<char> twice(count, 0);
  for (std::size_t i = count; i-- > 0;) {
    const Segment& s = graph.segments[i];
    chains.strahler[i] = std::max(1, chains.strahler[i] + twice[i]);
    chains.reach[i] += glm::length(s.b - s.a);
    if (s.parent < 0) continue;
    std::int32_t& order = chains.strahler[at(s.parent)];
    twice[at(s.parent)] = chains.strahler[i] == order ? 1 : chains.strahler[i] > order ? 0 : twice[at(s.parent)];
    order = std::max(order, chains.strahler[i]);
    chains.reach[at(s.parent)] = std::max(chains.reach[at(s.parent)], chains.reach[i]);
  }
}

/// What may continue a segment, with the largest values among its rivals.
struct Rivals {
  float reach = 0, radius = 0;
  std::int32_t strahler = 0;
  bool stem = false, pinned = false;
};

using Rank = std::tuple<bool, double, double, double, double, float, float, float>;

Rank rankOf(const Segment& parent, const Segment& child, float reach, std::int32_t strahler, bool pinned,
            const Rivals& rivals, const ChainSettings& settings) {
  const double cosine = cosineOfTurn(parent, child);
  const auto share = [](double value, double most) { return most > 0 ? value / most : 0; };
  const double length = static_cast<double>(reach), radius = static_cast<double>(child.ra);
  double score = length;
  if (settings.rule == ChainRule::Score) {
    score = settings.angle * (1 + cosine) / 2 + settings.length * share(length, static_cast<double>(rivals.reach)) +
            settings.thickness * share(radius, static_cast<double>(rivals.radius)) +
            settings.order * share(strahler, rivals.strahler);
  }
  return {pinned, score, radius, length, cosine, -child.b.x, -child.b.y, -child.b.z};
}

bool mayContinue(const Segment& parent, const Segment& child) {
  return (parent.kind == SegmentKind::Root) == (child.kind == SegmentKind::Root) &&
         glm::length(child.a - parent.b) <= 2 * parent.rb + 1e-5f;
}

std::vector<std::int32_t> continuations(const SkeletonGraph& graph, const Chains& chains,
                                        const ChainSettings& settings) {
  const std::size_t count = graph.segments.size();
  std::vector<Rivals> rivals(count);
  const auto pinned = [&](const Segment& s) {
    return s.branch >= 0 && s.branch == graph.segments[at(s.parent)].branch;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Segment& s = graph.segments[i];
    if (s.parent < 0 || !mayContinue(graph.segments[at(s.parent)], s)) continue;
    Rivals& r = rivals[at(s.parent)];
    r.reach = std::max(r.reach, chains.reach[i]);
    r.radius = std::max(r.radius, s.ra);
    r.strahler = std::max(r.strahler, chains.strahler[i]);
    r.stem = r.stem || s.kind != SegmentKind::Petiole;
  }
  std::vector<std::int32_t> next(count, -1);
  std::vector<Rank> best(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Segment& s = graph.segments[i];
    if (s.parent < 0) continue;
    const Segment& parent = graph.segments[at(s.parent)];
    const Rivals& r = rivals[at(s.parent)];
    if (!mayContinue(parent, s) || (s.kind == SegmentKind::Petiole && r.stem && !pinned(s))) continue;
    const Rank rank = rankOf(parent, s, chains.reach[i], chains.strahler[i], pinned(s), r, settings);
    if (next[at(s.parent)] < 0 || best[at(s.parent)] < rank) {
      next[at(s.parent)] = static_cast<std::int32_t>(i);
      best[at(s.parent)] = rank;
    }
  }
  return next;
}

}  // namespace

Chains findChains(const SkeletonGraph& graph, const ChainSettings& settings) {
  const std::size_t count = graph.segments.size();
  Chains result;
  measure(graph, result);
  const std::vector<std::int32_t> next = continuations(graph, result, settings);
  result.ofSegment.assign(count, -1);
  result.place.assign(count, 0);
  result.links.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t parent = graph.segments[i].parent;
    if (parent >= 0 && next[at(parent)] == static_cast<std::int32_t>(i)) continue;
    Chain chain;
    chain.first = static_cast<std::uint32_t>(result.links.size());
    chain.parentSegment = parent;
    chain.parent = parent < 0 ? -1 : result.ofSegment[at(parent)];
    chain.order = parent < 0 ? 1 : result.chains[at(chain.parent)].order + 1;
    for (auto s = static_cast<std::int32_t>(i); s >= 0; s = next[at(s)]) {
      result.ofSegment[at(s)] = static_cast<std::int32_t>(result.chains.size());
      result.place[at(s)] = static_cast<std::uint32_t>(result.links.size()) - chain.first;
      result.links.push_back(static_cast<std::uint32_t>(s));
    }
    chain.count = static_cast<std::uint32_t>(result.links.size()) - chain.first;
    result.chains.push_back(chain);
  }
  return result;
}

}  // namespace windfall::model
