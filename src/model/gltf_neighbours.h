// Files that a .gltf names beside itself.
#pragma once

#include <QByteArray>
#include <QDir>

#include "sim/result.h"

namespace windfall::model {

/// The .gltf with the buffers and pictures that it names in its folder, or below it, taken into it as data: a project
/// carries sources as single files. What lies elsewhere is not read, a missing picture is left out; a missing buffer is
/// an error. Bytes that are no JSON come back as they are.
Result<QByteArray> takeInNeighbours(const QByteArray& gltf, const QDir& folder);

}  // namespace windfall::model
