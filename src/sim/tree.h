// The rigid bodies of a tree: what an importer or a grower hands to the simulation.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kernels/math.h"

namespace windfall::sim {

/// A rigid link, one to one with an imported bone. SI units. Rest pose in the tree's own space (Y up, metres).
/// The link's local +z runs along the branch from its joint (tree_dynamics.md, 1).
struct Link {
  std::int32_t parent = -1;   ///< index of the parent link, always smaller than the own index; -1: stands on the ground
  std::int32_t chain = 0;     ///< index of the botanical axis (branch)
  std::int32_t order = 0;     ///< 0 trunk, 1 limb, 2 and on: twig
  vec3 joint{0};              ///< rest position of the joint
  quat rotation{1, 0, 0, 0};  ///< rest rotation, link to tree
  float length = 0;           ///< m
  float radius = 0;           ///< mean of the two ends, m
  float leafArea = 0;         ///< one-sided area of the leaves carried, m2
  float woodDensity = 950;    ///< green wood with water, kg/m3
  float youngsModulus = 6e9f;  ///< Pa
  float stiffnessScale = 1;    ///< artist's multipliers (tree_dynamics.md, 2.5)
  float dampingScale = 1;
  float windScale = 1;
  float rayleighAlpha = 0;   ///< 1/s, damping by mass, beside the structural one
  float rayleighBeta = 0;    ///< s, damping by stiffness, beside the structural one
  float propagation = 0.8f;  ///< of the forces method: share of a child's bending that reaches its parent, 0..1
};

/// Where a leaf hangs: the petiole's end in the link's own frame.
struct LeafSite {
  std::int32_t link = 0;
  vec3 position{0};           ///< m, link frame
  quat rotation{1, 0, 0, 0};  ///< leaf frame (see LeafInstance) to link frame
  float size = 0.08f;         ///< blade length, m
  std::uint32_t layer = 0;    ///< layer of the leaf texture array
};

/// A tree at rest. Links are stored parents before children, every subtree contiguous (depth-first preorder).
struct Tree {
  std::string name;
  std::vector<Link> links;
  std::vector<LeafSite> sites;
};

/// Tree to world: uniform scale is folded into the geometry before it gets here.
struct Placement {
  vec3 position{0};   ///< m
  float heading = 0;  ///< radians about +y
};

/// Masses of one link (tree_dynamics.md, 2.1).
struct LinkMass {
  float wood = 0;    ///< kg
  float leaves = 0;  ///< kg
};
LinkMass massOf(const Link& link);

/// Mass of wood and leaves of the whole tree, kg.
double totalMass(const Tree& tree);

/// First sway frequency of the whole tree in Hz by inverse iteration (tree_dynamics.md, 2.7); 0 for a tree without
/// links.
double firstFrequency(const Tree& tree);

}  // namespace windfall::sim
