// Whether an FBX file can be handed to Assimp, which walks its records and its nodes by recursion, without guard.
#pragma once

#include <QByteArray>

#include "sim/result.h"

namespace windfall::model {

/// Levels of nodes in a binary or text FBX file. Errors for files that are cut off, that nest their records without
/// end, and for nodes that are their own ancestors or have two parents.
Result<int> checkFbx(const QByteArray& bytes);

}  // namespace windfall::model
