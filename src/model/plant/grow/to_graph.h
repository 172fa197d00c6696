// A grown skeleton as the graph that readers make too.
#pragma once

#include "model/plant/grow/grown.h"
#include "model/plant/skeleton_graph.h"

namespace windfall::model::growth {

/// Link i + 1 of `grown` becomes segment i; axes are the branches that it names. `bones`, where given, tells the bone
/// that ends at each node.
SkeletonGraph toGraph(const Grown& grown, const std::vector<int>& bones = {});

}  // namespace windfall::model::growth
