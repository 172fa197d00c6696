#include "model/plant/grow/axes.h"

#include <cstdio>

namespace windfall::model::growth {

AxisTree axesOf(const Grown& grown) {
  AxisTree tree;
  std::vector<int> axisOf(grown.size(), -1), linkOf(grown.size(), -1);
  bool hasTrunk = false;
  for (std::size_t i = 1; i < grown.size(); ++i) {
    const std::size_t parent = at(grown.parent[i]);
    const bool onward = grown.continues[i] && axisOf[parent] >= 0;
    if (onward) {
      grower::Axis& axis = tree.axes[at(axisOf[parent])];
      axisOf[i] = axisOf[parent], linkOf[i] = static_cast<int>(axis.nodes.size()) - 1;
      axis.nodes.emplace_back(grown.position[i]);
      axis.radii.push_back(static_cast<float>(grown.radius[i]));
      continue;
    }
    grower::Axis axis;
    axis.parent = axisOf[parent];
    axis.parentLink = axis.parent >= 0 ? linkOf[parent] : 0;
    axis.parentShare = 1;
    axis.order = axis.parent >= 0 ? tree.axes[at(axis.parent)].order + 1 : 0;
    // Stems that stand on the root beside the trunk are its limbs, but carried by the ground.
    const bool trunk = axis.order == 0 && !hasTrunk;
    hasTrunk = hasTrunk || trunk;
    char name[32];
    std::snprintf(name, sizeof name,
                  axis.order >= 2   ? "twig.%04d"
                  : axis.order == 1 ? "limb.%04d"
                                    : "stem.%04d",
                  grown.source[i]);
    axis.name = trunk ? "trunk" : name;
    axis.nodes = {vec3(grown.position[parent]), vec3(grown.position[i])};
    const double base = trunk ? grown.radius[parent] : grown.radius[i];
    axis.radii = {static_cast<float>(base), static_cast<float>(grown.radius[i])};
    axisOf[i] = static_cast<int>(tree.axes.size()), linkOf[i] = 0;
    tree.axes.push_back(std::move(axis));
  }
  int bone = 0;
  for (grower::Axis& axis : tree.axes) {
    axis.firstBone = bone;
    bone += static_cast<int>(axis.nodes.size()) - 1;
  }
  tree.boneOf.assign(grown.size(), -1);
  tree.nodeOf.assign(at(bone), 0);
  for (std::size_t i = 1; i < grown.size(); ++i) {
    tree.boneOf[i] = tree.axes[at(axisOf[i])].firstBone + linkOf[i];
    tree.nodeOf[at(tree.boneOf[i])] = static_cast<int>(i);
  }
  return tree;
}

}  // namespace windfall::model::growth
