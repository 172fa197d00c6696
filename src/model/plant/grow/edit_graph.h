// Edits by hand on skeletons that a file gave.
#pragma once

#include "model/plant/grow/hand_edit.h"
#include "model/plant/skeleton_graph.h"

namespace windfall::model::growth {

/// The graph with the edits done in their order; those that find no place any more are left out, and their indices go
/// to `lost`. What stays keeps its state, organ and plant; new segments have those of what they grow from. Lengths
/// follow the new places. No edits: the same graph.
SkeletonGraph withEdits(const SkeletonGraph& graph, const std::vector<HandEdit>& edits,
                        std::vector<int>* lost = nullptr);

}  // namespace windfall::model::growth
