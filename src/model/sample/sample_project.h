// The project that a new user sees first; made from nothing but code.
#pragma once

#include "model/document/project.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model {

/// Painted leaves with new textures, trees of two growths wearing them, an autumn breeze with gusts. Always the same.
Result<Project> sampleProject(Progress& progress);

}  // namespace windfall::model
