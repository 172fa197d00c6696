// Whether all that a project carries can be used.
#pragma once

#include <QStringList>

#include "model/document/project.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model {

/// Loads every photo and every plant as the editor would; what is wrong, one line each ("plant “Birch”: …"). An error
/// only when cancelled.
Result<QStringList> checkSources(const Project& project, Progress& progress);

}  // namespace windfall::model
