// What a file does not say about its bones: where they end and how thick they are, from the mesh around them.
#pragma once

#include <optional>
#include <vector>

#include "model/plant/geometry.h"

namespace windfall::model {

/// What the file does say, a value a bone.
struct BoneHints {
  std::vector<std::optional<vec3>> ends;  ///< head of an end marker ("twig_end"), plant space
  std::vector<mat3> axes;                 ///< rest axes of the bone in plant space, unit columns
};

/// Sets tails: the end marker, else the only child's head, else the child or the mesh that goes on farthest along the
/// axis that this file's bones run along.
void fitTails(PlantGeometry& geometry, const BoneHints& hints);

/// Sets radii: median distance of the bark's vertices from the middle of the cross-section, over several stations along
/// the bone (tree_dynamics.md, 2.1). 0 for bones without bark: mendBones() gives them one.
void fitRadii(PlantGeometry& geometry);

}  // namespace windfall::model
