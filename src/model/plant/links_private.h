// Which bones become links; shared by branches and bodies.
#pragma once

#include <vector>

#include "model/plant/bodies.h"

namespace windfall::model {

/// The bones that become links, as a forest of their own.
struct LinkForest {
  std::vector<char> link;                  ///< a bone: becomes a link
  std::vector<int> parent;                 ///< a bone: nearest ancestor that becomes a link, or -1
  std::vector<std::vector<int>> children;  ///< a bone: those whose `parent` it is
  std::vector<int> next;                   ///< a bone: the child that continues its branch, or -1
};

/// Long enough for its thickness to be simulated as a link; what is shorter moves with its parent.
bool bends(const Bone& bone);

/// Bones without weights or without length become no links; their children go to their parent (plant_meshing.md, 1).
/// A branch goes on with the child of the longest way to a tip, if it starts near the bone's end (1.1, "longest").
LinkForest linkForest(const std::vector<Bone>& bones);

/// Sites for a plant whose mesh has no leaves: along the terminal branches (growers.md, 5.3), in bone frames.
std::vector<sim::LeafSite> leafSitesOnTerminals(const std::vector<Bone>& bones, const std::vector<Branch>& branches,
                                                double leafArea);

/// One-sided area of all leaves, m2: 2000 pi R^2 of the trunks' bases (tree_dynamics.md, 2.4), at most a leaf area
/// index of 6 over the crown's ground (growers.md, 5.2).
double naturalLeafArea(const std::vector<Bone>& bones, const std::vector<Branch>& branches);

/// Thickens links that could not stand: none is thinner than what it carries, and none carries more than an eighth of
/// the load under which it would buckle (tree_dynamics.md, 2.7; McMahon 1973 found trees at a quarter of the critical
/// height, far safer still). Meshes often narrow to a point where one spline ends and the next begins, and draw limbs
/// of metres as wires; such necks would sway long before the trunk does. Takes the wood's properties as they are.
void makeSelfSupporting(sim::Tree& tree);

/// Mends what the simulation would refuse (sim/tree_repair.h) and tells it in `bodies.notes`; links that had to be put
/// in another order keep their bones.
void mendLinks(PlantBodies& bodies);

/// Branches that carry no other branch.
std::vector<char> terminalBranches(const std::vector<Branch>& branches);

}  // namespace windfall::model
