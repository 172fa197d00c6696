// From bones to branches and to the rigid bodies that the wind bends (tree_dynamics.md, 2).
#pragma once

#include <QString>
#include <QStringList>
#include <vector>

#include "model/plant/geometry.h"
#include "model/plant/plant.h"

namespace windfall::model {

/// A botanical axis: consecutive bones from base to tip.
struct Branch {
  QString name;
  int parent = -1;  ///< branch that it leaves
  int order = 0;    ///< 0 trunk
  std::vector<int> bones;
  double length = 0;      ///< m
  double baseRadius = 0;  ///< m
};

/// The branches of a skeleton, trunk first, by greatest length.
std::vector<Branch> findBranches(const std::vector<Bone>& bones);

/// The bodies of a plant: bone i of the geometry is link `linkOfBone[i]`. Edits are applied; `layers` is the number of
/// leaf textures that its leaves choose from.
struct PlantBodies {
  sim::Tree tree;
  std::vector<Branch> branches;
  std::vector<int> linkOfBone;  ///< -1 for bones that became no link
  std::vector<int> boneOfLink;
  std::vector<int> carrierOfBone;  ///< link that moves the bone's vertices: its own, or its nearest ancestor's
  QStringList notes;               ///< what had to be mended so that the simulation takes the tree
};
PlantBodies buildBodies(const PlantGeometry& geometry, const Plant& plant, int firstLayer = 0, int layers = 1);

/// `windfall plant --info`.
struct PlantInfo {
  QString format;
  int plants = 1, nodes = 0, bones = 0, rigidBodies = 0, chains = 0, depth = 0, stems = 0, leaves = 0, buds = 0,
      maxInfluences = 0;
  double totalStemLength = 0, mass = 0, firstFrequency = 0;
  double selfBuckling = 0;  ///< own weight over what makes it buckle (sim/self_buckling.h)
  QStringList clips, notes;
  vec3 lower{0}, upper{0};  ///< bounding box, m
};
PlantInfo describe(const PlantGeometry& geometry, const PlantBodies& bodies);

}  // namespace windfall::model
