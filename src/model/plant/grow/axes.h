// From a skeleton of nodes to axes, each a line of links.
#pragma once

#include <vector>

#include "model/plant/grow/grown.h"
#include "model/plant/grower_private.h"

namespace windfall::model::growth {

struct AxisTree {
  std::vector<grower::Axis> axes;  ///< parents before children
  std::vector<int> boneOf;         ///< a node: the bone that ends there, -1 for the root
  std::vector<int> nodeOf;         ///< a bone: the node at its end
};

/// Follows the axis flags. Names tell the grower's number of an axis' first node, so that they stay while the plant
/// grows on: "trunk", "limb.0123", "twig.0456".
AxisTree axesOf(const Grown& grown);

}  // namespace windfall::model::growth
