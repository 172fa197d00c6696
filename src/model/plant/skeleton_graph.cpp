#include "model/plant/skeleton_graph.h"

#include <algorithm>
#include <cmath>

#include "model/plant/frames.h"

namespace windfall::model {

namespace {

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

/// Farther out nothing grows; keeps sums finite.
constexpr float kFarthestPoint = 1e6f;

bool sound(vec3 p) {
  return std::abs(p.x) <= kFarthestPoint && std::abs(p.y) <= kFarthestPoint && std::abs(p.z) <= kFarthestPoint;
}

bool soundLength(float length) { return length >= 0 && length <= kFarthestPoint; }

std::string place(std::int32_t plant, const char* what, std::int32_t organ, std::size_t index) {
  return "plant " + std::to_string(plant + 1) + ", " + what + " " +
         std::to_string(organ >= 0 ? static_cast<std::size_t>(organ) : index) + ": ";
}

Status check(const SkeletonGraph& graph) {
  const auto count = static_cast<std::int32_t>(graph.segments.size());
  for (std::size_t i = 0; i < graph.segments.size(); ++i) {
    const Segment& s = graph.segments[i];
    const std::string where = place(s.plant, s.kind == SegmentKind::Root ? "root" : "organ", s.organ, i);
    if (!sound(s.a) || !sound(s.b)) return Error{where + "its place is no number or out of this world"};
    if (!soundLength(s.ra) || !soundLength(s.rb) || !soundLength(s.length))
      return Error{where + "its length or radius is no length"};
    if (s.parent < -1 || s.parent >= count) return Error{where + "its parent is not there"};
    if (s.parent == static_cast<std::int32_t>(i)) return Error{where + "is its own parent"};
  }
  for (std::size_t i = 0; i < graph.leaves.size(); ++i) {
    const LeafOrgan& leaf = graph.leaves[i];
    const std::string where = place(leaf.plant, "leaf", leaf.organ, i);
    if (!sound(leaf.base) || !sound(leaf.tip) || !sound(leaf.normal) || !soundLength(leaf.width)) {
      return Error{where + "its place is no number or out of this world"};
    }
    if (leaf.segment < -1 || leaf.segment >= count) return Error{where + "its parent is not there"};
  }
  for (std::size_t i = 0; i < graph.buds.size(); ++i) {
    const BudOrgan& bud = graph.buds[i];
    const std::string where = place(bud.plant, "bud", bud.organ, i);
    if (!sound(bud.centre) || !soundLength(bud.radius)) {
      return Error{where + "its place is no number or out of this world"};
    }
    if (bud.segment < -1 || bud.segment >= count) return Error{where + "its parent is not there"};
  }
  return ok();
}

}  // namespace

Result<SkeletonGraph> sortedGraph(SkeletonGraph graph) {
  if (const Status status = check(graph); !status) return status.error();
  const std::size_t count = graph.segments.size();
  bool sorted = true;
  for (std::size_t i = 0; i < count && sorted; ++i) sorted = graph.segments[i].parent < static_cast<std::int32_t>(i);
  if (sorted) return graph;

  // Each segment after its parent, otherwise in the order of the file; a chain of parents is walked once.
  std::vector<std::int32_t> place(count, -1), order, chain;
  std::vector<char> walking(count, 0);
  order.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (auto s = static_cast<std::int32_t>(i); s >= 0 && place[at(s)] < 0; s = graph.segments[at(s)].parent) {
      if (walking[at(s)]) {
        const Segment& loop = graph.segments[at(s)];
        return Error{::windfall::model::place(loop.plant, "organ", loop.organ, at(s)) + "is its own ancestor"};
      }
      walking[at(s)] = 1;
      chain.push_back(s);
    }
    for (; !chain.empty(); chain.pop_back()) {
      place[at(chain.back())] = static_cast<std::int32_t>(order.size());
      order.push_back(chain.back());
    }
  }
  std::vector<Segment> segments;
  segments.reserve(count);
  for (const std::int32_t from : order) {
    segments.push_back(graph.segments[at(from)]);
    if (segments.back().parent >= 0) segments.back().parent = place[at(segments.back().parent)];
  }
  graph.segments = std::move(segments);
  for (LeafOrgan& leaf : graph.leaves) leaf.segment = leaf.segment < 0 ? -1 : place[at(leaf.segment)];
  for (BudOrgan& bud : graph.buds) bud.segment = bud.segment < 0 ? -1 : place[at(bud.segment)];
  return graph;
}

void finishGraph(SkeletonGraph& graph) {
  std::vector<int> stems(graph.segments.size(), 0), leaves(graph.segments.size(), 0);
  for (const LeafOrgan& leaf : graph.leaves) {
    if (leaf.segment >= 0) ++leaves[at(leaf.segment)];
  }
  for (Segment& s : graph.segments) {
    if (s.parent < 0) continue;
    ++stems[at(s.parent)];
    const Segment& parent = graph.segments[at(s.parent)];
    s.attach = glm::length(s.a - parent.b) <= 1e-4f ? 1.0f : closestShare(parent.a, parent.b, s.a);
  }
  for (std::size_t i = 0; i < graph.segments.size(); ++i) {
    Segment& s = graph.segments[i];
    if (s.kind == SegmentKind::Root) continue;
    s.kind = s.parent >= 0 && stems[i] == 0 && leaves[i] == 1 ? SegmentKind::Petiole : SegmentKind::Stem;
  }
}

SkeletonGraph withoutStubs(const SkeletonGraph& graph, std::vector<std::int32_t>* kept) {
  const std::size_t count = graph.segments.size();
  std::vector<std::int32_t> place(count, -1);
  std::vector<float> run(count, 0);  // length dropped just below, m
  SkeletonGraph result;
  result.plants = graph.plants;
  result.obstacles = graph.obstacles;
  result.segments.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Segment s = graph.segments[i];
    const float limit = std::max(1e-4f, 0.1f * s.ra);
    const bool root = s.parent < 0;
    const bool afterStub = !root && run[at(s.parent)] > 0;
    const float length = glm::length(s.b - s.a) + (root ? 0 : run[at(s.parent)]);
    if (!root && length < limit) {
      place[i] = place[at(s.parent)];
      run[i] = length;
      continue;
    }
    if (!root) {
      s.parent = place[at(s.parent)];
      const Segment& parent = result.segments[at(s.parent)];
      if (afterStub || s.attach >= 1) {
        // What starts where a stub ended starts at the end that is left.
        if (glm::length(s.a - parent.b) <= std::max(2e-4f, 0.2f * s.ra)) s.a = parent.b;
        s.attach = 1;
      }
    }
    place[i] = static_cast<std::int32_t>(result.segments.size());
    result.segments.push_back(s);
  }
  result.leaves = graph.leaves;
  result.buds = graph.buds;
  for (LeafOrgan& leaf : result.leaves) leaf.segment = leaf.segment < 0 ? -1 : place[at(leaf.segment)];
  for (BudOrgan& bud : result.buds) bud.segment = bud.segment < 0 ? -1 : place[at(bud.segment)];
  if (kept != nullptr) *kept = std::move(place);
  return result;
}

SkeletonGraph scaled(SkeletonGraph graph, double scale) {
  const auto k = static_cast<float>(scale);
  for (Segment& s : graph.segments) s.a *= k, s.b *= k, s.ra *= k, s.rb *= k, s.length *= k;
  for (LeafOrgan& leaf : graph.leaves) leaf.base *= k, leaf.tip *= k, leaf.width *= k;
  for (BudOrgan& bud : graph.buds) bud.centre *= k, bud.radius *= k;
  for (Obstacle& obstacle : graph.obstacles) {
    for (vec3& p : obstacle.points) p *= k;
  }
  return graph;
}

}  // namespace windfall::model
