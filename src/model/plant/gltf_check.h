// Looks through a glTF file before Assimp reads it: Assimp trusts indices, sizes and the shape of the node tree.
#pragma once

#include <QByteArray>

#include "sim/result.h"

namespace windfall::model {

/// Refuses files that are cut off, whose sizes lie, whose nodes form circles, or that point outside themselves
/// (glTF 2.0 specification, sections 3.5, 3.6, 4.4). `binary` for .glb. The levels of its nodes (hierarchy.h).
Result<int> checkGltf(const QByteArray& bytes, bool binary);

}  // namespace windfall::model
