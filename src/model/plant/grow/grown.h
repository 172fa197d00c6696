// What every grower makes: a skeleton in the order of its birth (growers.md, introduction).
#pragma once

#include <cstddef>
#include <vector>

#include "kernels/math.h"

namespace windfall::model::growth {

using glm::dquat;
using glm::dvec3;

/// A leaf that a rule put in its place.
struct GivenLeaf {
  int node = 0;  ///< at whose end it hangs
  dvec3 position{0}, direction{0, 1, 0}, up{0, 0, 1};
  double length = 0.05;  ///< m
  int colour = 0;        ///< index chosen by the rules
};

/// Nodes with their links to their parents: link i runs from parent[i] to i. Node 0 is the only root, at the ground;
/// parents stand before children. Metres, Y up.
struct Grown {
  std::vector<dvec3> position;
  std::vector<int> parent;      ///< -1: the root
  std::vector<double> radius;   ///< m; set by setRadii or by the rules
  std::vector<int> birth;       ///< round, year or generation
  std::vector<char> continues;  ///< the link continues its parent's axis
  std::vector<int> source;      ///< the node's number in the grower, kept through merging
  std::vector<GivenLeaf> leaves;
  double length = 0;  ///< of the whole growth, in rounds or years: what `birth` counts up to

  std::size_t size() const { return position.size(); }
  int add(dvec3 at, int from, int born, bool onward = false) {
    position.push_back(at);
    parent.push_back(from);
    radius.push_back(0);
    birth.push_back(born);
    continues.push_back(onward ? 1 : 0);
    source.push_back(static_cast<int>(source.size()));
    return static_cast<int>(position.size()) - 1;
  }
};

inline std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Children of every node, ascending.
std::vector<std::vector<int>> childrenOf(const Grown& grown);

/// Keeps the nodes with keep[i] set whose parents are kept too; node 0 always stays. Leaves of lost nodes go.
void keepOnly(Grown& grown, const std::vector<char>& keep);

/// Every x_i moves half the way to its parent, tips first: acute forks (1.5, 1).
void relocate(Grown& grown);
/// Drops nodes with one child where the turn is below `degrees` and the merged link shorter than `longest` m (1.5, 2).
void mergeStraight(Grown& grown, double degrees, double longest);
/// The thickest child continues its parent's axis; radii must be set (1.5, 3).
void chooseAxes(Grown& grown);
/// x_i <- x_i/2 + (x_before + x_after)/4 along every axis, `rounds` times (1.5, 4).
void smooth(Grown& grown, int rounds);

/// The pipe model with taper: tips get `tip`, r_p^2.4 = sum (r_c + taper l_c)^2.4 (5.1). Returns the root's radius.
double pipeRadii(Grown& grown, double tip, double taper, double exponent = 2.4);
/// The same with the taper for which the root's radius is `base`. Where even no taper is too thick the tips get
/// thinner.
void setRadii(Grown& grown, double tip, double base);

/// Distance from each node to its subtree's farthest tip, m.
std::vector<double> reachOf(const Grown& grown);
/// 0 trunk, 1 limb, ... by the axis flags.
std::vector<int> ordersOf(const Grown& grown);

}  // namespace windfall::model::growth
