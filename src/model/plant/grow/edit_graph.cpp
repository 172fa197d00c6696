#include "model/plant/grow/edit_graph.h"

#include <algorithm>

#include "model/plant/grow/grow_skeleton.h"

namespace windfall::model::growth {

namespace {

/// The growers' form of a graph. Node 0 stands at the first root; every root has a node at its foot, and each segment
/// one at its end, whose source is the segment's index.
class Shaping {
 public:
  explicit Shaping(const SkeletonGraph& graph) : graph_(graph) {
    nodeOf_.resize(graph.segments.size());
    std::vector<char> onward(graph.segments.size(), 0);
    for (std::size_t i = 0; i < graph.segments.size(); ++i) {
      const Segment& s = graph.segments[i];
      int from = 0;
      if (s.parent >= 0) {
        from = nodeOf_[at(s.parent)];
      } else {
        if (grown_.size() == 0) add(s.a, -1, s.ra, kFoot, false);
        from = add(s.a, 0, s.ra, kFoot, false);
      }
      // Where the source names no branches, the first child is as good as any.
      const bool named = s.parent >= 0 && s.branch >= 0 && s.branch == graph.segments[at(s.parent)].branch;
      const bool first = s.parent >= 0 && s.branch < 0 && !onward[at(s.parent)];
      if (first) onward[at(s.parent)] = 1;
      nodeOf_[i] = add(s.b, from, s.rb, static_cast<int>(i), s.parent < 0 || named || first);
    }
    for (std::size_t l = 0; l < graph.leaves.size(); ++l) {
      const LeafOrgan& leaf = graph.leaves[l];
      GivenLeaf given;
      given.node = leaf.segment >= 0 ? nodeOf_[at(leaf.segment)] : 0;
      given.position = dvec3(leaf.base);
      given.direction = dvec3(leaf.tip - leaf.base);
      given.up = dvec3(leaf.normal);
      given.colour = static_cast<int>(l);
      grown_.leaves.push_back(given);
    }
  }

  SkeletonGraph shaped(const std::vector<HandEdit>& edits, std::vector<int>* lost) {
    const Grown before = grown_;
    const std::vector<int> missed = applyEdits(grown_, edits, std::vector<char>(edits.size(), 0));
    if (lost != nullptr) *lost = missed;
    SkeletonGraph result;
    result.plants = graph_.plants;
    result.obstacles = graph_.obstacles;
    std::vector<std::int32_t> segmentOf(grown_.size(), -1), placeOf(graph_.segments.size(), -1);
    std::int32_t branches = 0;
    for (const Segment& s : graph_.segments) branches = std::max(branches, s.branch + 1);
    for (std::size_t i = 1; i < grown_.size(); ++i) {
      if (grown_.source[i] == kFoot) continue;
      const std::size_t parent = at(grown_.parent[i]);
      segmentOf[i] = static_cast<std::int32_t>(result.segments.size());
      Segment own;
      if (grown_.source[i] >= 0 && at(grown_.source[i]) < graph_.segments.size()) {
        own = kept(before, i, parent);
        placeOf[at(grown_.source[i])] = segmentOf[i];
      } else {
        own = added(i, parent, result, segmentOf[parent], branches);
      }
      own.parent = segmentOf[parent];
      result.segments.push_back(own);
    }
    for (const GivenLeaf& given : grown_.leaves) {
      LeafOrgan leaf = graph_.leaves[at(given.colour)];
      leaf.segment = leaf.segment < 0 ? -1 : segmentOf[at(given.node)];
      leaf.base = vec3(given.position);
      leaf.tip = vec3(given.position + given.direction);
      leaf.normal = vec3(given.up);
      result.leaves.push_back(leaf);
    }
    for (BudOrgan bud : graph_.buds) {
      if (bud.segment >= 0) {
        const std::int32_t on = placeOf[at(bud.segment)];
        if (on < 0) continue;
        bud.centre += result.segments[at(on)].b - graph_.segments[at(bud.segment)].b;
        bud.segment = on;
      }
      result.buds.push_back(bud);
    }
    finishGraph(result);
    return result;
  }

 private:
  static constexpr int kFoot = -2;  ///< source of the nodes that end no segment; -1 is that of edits without a number

  int add(vec3 place, int from, float radius, int source, bool onward) {
    const int node = grown_.add(dvec3(place), from, 0, onward);
    grown_.radius[at(node)] = std::max(static_cast<double>(radius), 1e-5);
    grown_.source[at(node)] = source;
    return node;
  }

  Segment kept(const Grown& before, std::size_t node, std::size_t parent) const {
    Segment own = graph_.segments[at(grown_.source[node])];
    const std::size_t was = at(nodeOf_[at(grown_.source[node])]);
    const dvec3 shift = grown_.position[parent] - before.position[at(before.parent[was])];
    const vec3 a = own.a + vec3(shift), b = vec3(grown_.position[node]);
    const auto wider = static_cast<float>(grown_.radius[node] / before.radius[was]);
    if (a != own.a || b != own.b) own.length = glm::length(b - a);
    own.a = a, own.b = b;
    own.ra *= wider, own.rb *= wider;
    return own;
  }

  Segment added(std::size_t node, std::size_t parent, const SkeletonGraph& made, std::int32_t below,
                std::int32_t& branches) const {
    Segment own;
    own.a = vec3(grown_.position[parent]);
    own.b = vec3(grown_.position[node]);
    own.ra = static_cast<float>(std::min(grown_.radius[parent], 1.2 * grown_.radius[node]));
    own.rb = static_cast<float>(grown_.radius[node]);
    own.length = glm::length(own.b - own.a);
    if (below >= 0) {
      const Segment& bearer = made.segments[at(below)];
      own.plant = bearer.plant;
      own.state = bearer.state;
      const bool carriesOn = grown_.continues[node] && bearer.organ < 0;
      if (bearer.branch >= 0) own.branch = carriesOn ? bearer.branch : branches++;
    }
    return own;
  }

  const SkeletonGraph& graph_;
  std::vector<int> nodeOf_;  ///< by segment
  Grown grown_;
};

}  // namespace

SkeletonGraph withEdits(const SkeletonGraph& graph, const std::vector<HandEdit>& edits, std::vector<int>* lost) {
  if (edits.empty() || graph.segments.empty()) return graph;
  return Shaping(graph).shaped(edits, lost);
}

}  // namespace windfall::model::growth
