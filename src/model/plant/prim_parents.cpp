#include <algorithm>
#include <cmath>
#include <limits>

#include "model/plant/frames.h"
#include "model/plant/prim_private.h"

namespace windfall::model::prim {

namespace {

/// Nearest of many points, by halving space; ties go to the lowest index.
class PointTree {
 public:
  explicit PointTree(std::vector<vec3> points) : points_(std::move(points)), order_(points_.size()) {
    for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = i;
    split(0, order_.size(), 0);
  }

  /// -1 where there is none but `except` within `reach`.
  std::int64_t nearest(vec3 p, float reach, std::int64_t except) const {
    Best best{static_cast<double>(reach) * static_cast<double>(reach), -1};
    find(p, except, 0, order_.size(), 0, best);
    return best.index;
  }

 private:
  struct Best {
    double squared;
    std::int64_t index;
  };

  void split(std::size_t first, std::size_t end, int axis) {
    if (end - first < 2) return;
    const std::size_t middle = first + (end - first) / 2;
    const auto begin = order_.begin();
    std::nth_element(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
                     begin + static_cast<std::ptrdiff_t>(end), [&](std::size_t a, std::size_t b) {
                       return std::make_pair(points_[a][axis], a) < std::make_pair(points_[b][axis], b);
                     });
    split(first, middle, (axis + 1) % 3);
    split(middle + 1, end, (axis + 1) % 3);
  }

  void find(vec3 p, std::int64_t except, std::size_t first, std::size_t end, int axis, Best& best) const {
    if (first >= end) return;
    const std::size_t middle = first + (end - first) / 2, point = order_[middle];
    const auto index = static_cast<std::int64_t>(point);
    const glm::dvec3 d = glm::dvec3(points_[point]) - glm::dvec3(p);
    const double squared = glm::dot(d, d);
    const bool nearer = squared < best.squared || (squared == best.squared && (best.index < 0 || index < best.index));
    if (index != except && nearer) best = {squared, index};
    const double off = static_cast<double>(p[axis]) - static_cast<double>(points_[point][axis]);
    const int next = (axis + 1) % 3;
    const auto below = [&] { find(p, except, first, middle, next, best); };
    const auto above = [&] { find(p, except, middle + 1, end, next, best); };
    if (off <= 0) {
      below();
      if (off * off <= best.squared) above();
    } else {
      above();
      if (off * off <= best.squared) below();
    }
  }

  std::vector<vec3> points_;
  std::vector<std::size_t> order_;
};

/// How far a base may lie from the tip that it touches, m.
float slack(float radius) { return std::max(2e-4f, 0.5f * radius); }

bool descends(const SkeletonGraph& graph, std::int64_t s, std::int64_t from) {
  for (; s >= 0; s = graph.segments[static_cast<std::size_t>(s)].parent) {
    if (s == from) return true;
  }
  return false;
}

/// The thicker segment whose side a base touches.
std::int64_t touchedSide(const SkeletonGraph& graph, std::size_t first, std::size_t segment) {
  const Segment& s = graph.segments[segment];
  std::int64_t best = -1;
  float nearest = std::numeric_limits<float>::max();
  for (std::size_t i = first; i < graph.segments.size(); ++i) {
    const Segment& side = graph.segments[i];
    if (i == segment || side.kind == SegmentKind::Root || side.ra < s.ra) continue;
    const float share = closestShare(side.a, side.b, s.a);
    const float distance = glm::length(side.a + (side.b - side.a) * share - s.a);
    if (distance > side.ra + 1e-4f || distance >= nearest || share <= 0) continue;
    if (descends(graph, static_cast<std::int64_t>(i), static_cast<std::int64_t>(segment))) continue;
    nearest = distance, best = static_cast<std::int64_t>(i);
  }
  return best;
}

}  // namespace

void findParents(SkeletonGraph& graph, const Range& from) {
  std::vector<vec3> tips;
  for (std::size_t i = from.segment; i < graph.segments.size(); ++i) {
    const vec3 tip = graph.segments[i].b;
    // What is no number is refused later, with its place; here it must only not upset the tree.
    tips.push_back(std::isfinite(tip.x + tip.y + tip.z) ? tip : vec3(std::numeric_limits<float>::max()));
  }
  if (tips.empty()) return;
  const auto offset = static_cast<std::int64_t>(from.segment);
  const PointTree tree(tips);
  const auto count = static_cast<std::int64_t>(tips.size());
  std::int64_t searches = 0;
  // Bounded: a stream of nothing but loose ends or circles must not cost the square of its length.
  constexpr std::int64_t kMostWork = 20'000'000;
  for (std::size_t i = from.segment; i < graph.segments.size(); ++i) {
    Segment& s = graph.segments[i];
    if (s.parent >= 0) continue;
    const std::int64_t own = static_cast<std::int64_t>(i) - offset;
    std::int64_t found = tree.nearest(s.a, slack(s.ra), own);
    if (found >= 0) {
      // A way up of any length, so the walks count as work too.
      std::int64_t steps = 0, up = found + offset;
      while (up >= 0 && up != static_cast<std::int64_t>(i) && steps <= count) {
        up = graph.segments[static_cast<std::size_t>(up)].parent, ++steps;
      }
      searches += steps;
      if (up >= 0) found = -1;
    }
    s.parent = static_cast<std::int32_t>(found < 0 ? -1 : found + offset);
    if (searches > kMostWork) break;
  }
  for (std::size_t i = from.segment; i < graph.segments.size(); ++i) {
    if (graph.segments[i].parent >= 0 || (searches += count) > kMostWork) continue;
    graph.segments[i].parent = static_cast<std::int32_t>(touchedSide(graph, from.segment, i));
  }
  const auto bearer = [&](vec3 base, float reach) {
    const std::int64_t found = tree.nearest(base, reach, -1);
    return static_cast<std::int32_t>(found < 0 ? -1 : found + offset);
  };
  for (std::size_t i = from.leaf; i < graph.leaves.size(); ++i) {
    LeafOrgan& leaf = graph.leaves[i];
    if (leaf.segment < 0) leaf.segment = bearer(leaf.base, 0.01f + 0.1f * leaf.width);
  }
  for (std::size_t i = from.bud; i < graph.buds.size(); ++i) {
    BudOrgan& bud = graph.buds[i];
    if (bud.segment < 0) bud.segment = bearer(bud.centre, 0.01f + 2 * bud.radius);
  }
}

}  // namespace windfall::model::prim
