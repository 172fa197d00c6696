// `windfall simulate FILE --bake OUT`: a loopable clip of the wind.
#pragma once

#include <QString>

#include "model/document/project.h"
#include "model/progress.h"

namespace windfall::app {

/// Bakes a looping clip of `seconds` in the scene's wind for the first plant that stands in the scene, and writes it to
/// `target`: with the plant as .glb or .gltf, or with the whole project as .windfall. `path` names the source in
/// errors. The process's exit status.
int bakeInto(model::Project project, const QString& path, const QString& target, double seconds,
             model::Progress& progress);

}  // namespace windfall::app
