// The thesis's JSON form of skeletons (prim_format.md, "The older JSON format").
#pragma once

#include <QByteArray>
#include <QStringList>

#include "model/plant/skeleton_graph.h"

namespace windfall::model {

struct JsonSkeleton {
  SkeletonGraph graph;   ///< an edge from a node to its child is a segment; each root a plant
  QStringList warnings;  ///< unknown fields
};

/// Field names without regard to case. Errors, one line, with the node's id: not JSON, two nodes of one id, children
/// that are not there or have two parents, loops, numbers that are none, no plants.
Result<JsonSkeleton> readJsonSkeleton(const QByteArray& bytes);

/// `chainOfSegment`: the branch of each segment. Where a branch starts in the middle of a segment, that is split.
QByteArray writeJsonSkeleton(const SkeletonGraph& graph, const std::vector<std::int32_t>& chainOfSegment);

}  // namespace windfall::model
