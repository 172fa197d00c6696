// AgroEcoSim's .prim streams, versions 1 to 6 (prim_format.md).
#pragma once

#include <QByteArray>
#include <QStringList>

#include "model/plant/skeleton_graph.h"

namespace windfall::model {

struct PrimFile {
  int version = 0;
  SkeletonGraph graph;   ///< sorted and finished; versions 1 to 3 with parents found from who touches whom
  QStringList warnings;  ///< what was odd but could be read
};

/// Reads a stream of any version. Counts are checked against the bytes that are left before anything is reserved.
/// Errors, one line, with plant, organ and byte: cut off, lying counts, unknown version or organ, loops, parents that
/// are not there, numbers that are none, no plants.
Result<PrimFile> readPrim(const QByteArray& bytes);

/// Writes a graph as version 3, 4, 5 or 6; 3 drops parents and state, 3 to 5 drop roots, all drop obstacles, which no
/// version from 4 on can hold. Unknown shares become 1. An error for other versions.
Result<QByteArray> writePrim(const SkeletonGraph& graph, int version);

}  // namespace windfall::model
