// The .windfall file: a zip of project.json and the sources beside it.
#pragma once

#include <QString>

#include "model/document/project.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model {

/// Version of project.json that this program writes; older ones are upgraded while reading, newer ones refused.
inline constexpr int schemaVersion = 1;

/// Reads a project. One clear line for a damaged, truncated, newer or hostile file.
Result<Project> readProject(const QString& path, Progress& progress);

/// Writes beside the target, syncs, renames: the old file is whole until the new one is. Equal projects give equal
/// bytes.
Status writeProject(const Project& project, const QString& path, Progress& progress);

}  // namespace windfall::model
