#include "model/plant/grow/to_graph.h"

#include <algorithm>

namespace windfall::model::growth {

SkeletonGraph toGraph(const Grown& grown, const std::vector<int>& bones) {
  SkeletonGraph graph;
  std::vector<std::int32_t> axis(grown.size(), 0);
  std::int32_t axes = 0;
  for (std::size_t i = 1; i < grown.size(); ++i) {
    const std::size_t parent = at(grown.parent[i]);
    // Onward from the root is the trunk itself.
    axis[i] = grown.continues[i] && (parent > 0 || axes == 0) ? (parent > 0 ? axis[parent] : axes++) : axes++;
    Segment segment;
    segment.a = vec3(grown.position[parent]);
    segment.b = vec3(grown.position[i]);
    const bool onward = i == 1 || axis[i] == axis[parent];
    segment.ra =
        static_cast<float>(onward ? grown.radius[parent] : std::min(grown.radius[i] * 1.05, grown.radius[parent]));
    segment.rb = static_cast<float>(grown.radius[i]);
    segment.length = glm::length(segment.b - segment.a);
    segment.parent = parent == 0 ? -1 : static_cast<std::int32_t>(parent) - 1;
    segment.organ = static_cast<std::int32_t>(i) - 1;
    segment.bone = bones.empty() ? -1 : bones[i];
    segment.branch = axis[i];
    graph.segments.push_back(segment);
  }
  for (const GivenLeaf& given : grown.leaves) {
    LeafOrgan leaf;
    leaf.segment = std::max(given.node - 1, 0);
    leaf.organ = static_cast<std::int32_t>(graph.segments.size() + graph.leaves.size());
    leaf.base = vec3(given.position);
    leaf.tip = vec3(given.position + given.length * given.direction);
    leaf.normal = vec3(given.up);
    leaf.width = static_cast<float>(0.6 * given.length);
    graph.leaves.push_back(leaf);
  }
  return graph;
}

}  // namespace windfall::model::growth
