// Projects made from files, ready to be looked at.
#pragma once

#include <vector>

#include "model/document/project.h"
#include "model/progress.h"
#include "model/source_file.h"
#include "sim/result.h"

namespace windfall::model {

/// Adds so many textures to a leaf, of the seeds that follow its highest one, all kept. An error where no leaf is found
/// in the photo.
Status synthesizeVariants(Leaf& leaf, int count, Progress& progress);

/// Shows a box (m) as a whole, a little from above the ground.
Camera cameraFor(const vec3& lower, const vec3& upper);

/// A leaf for each photo, with `variants` new textures; a plant for each file, all leaves on each; the first plant
/// stands in the scene. Errors begin with the name of the file.
Result<Project> projectFromFiles(const std::vector<SourceFile>& photos, const std::vector<SourceFile>& plants,
                                 int variants, Progress& progress);

}  // namespace windfall::model
