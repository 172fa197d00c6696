// What cards of leaves are made of: clusters and boughs of every kind of tree, and which leaf belongs to which.
#pragma once

#include <atomic>
#include <cstdint>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "kernels/leaf_instance.h"
#include "widgets/render/content.h"

namespace windfall::render {

/// Directions from which each cluster's picture is taken, rest space of its tree: six round it from a little above,
/// three from halfway up, one from the top.
inline constexpr std::size_t kCardViews = 10;
vec3 cardView(std::size_t view);

/// As in cards.glsl. Places of other nodes count within the plant.
struct CardNode {
  vec4 sphere{0};                 ///< m, rest space
  vec4 spread{0};                 ///< mean of n n^T of the blades' normals: xx, yy, zz; mean blade length, m
  vec4 spreadAndArea{0};          ///< xy, xz, yz; sum of the squared lengths of the leaves in the picture, m2
  glm::ivec4 place{0, -1, 0, 0};  ///< link in its tree, bough (-1: it is one), first cluster, number of clusters
  glm::uvec4 picture{0};          ///< first layer of its pictures, leaf layer of its first leaf
};

/// A node of a tree that stands in the scene.
struct CardInstance {
  std::uint32_t node = 0, firstLink = 0;
};

/// Leaves of a node in CardPlant::leaves.
struct CardLeaves {
  std::uint32_t first = 0, count = 0;
};

/// A kind of tree: its nodes and all that stand of it.
struct CardPlant {
  std::uint32_t firstNode = 0, nodeCount = 0, boughs = 0;
  std::uint32_t firstInstance = 0, instanceCount = 0;
  int tile = 48;  ///< px, side of a picture
  /// Leaves of its first tree at rest, in its own space, cluster by cluster; `state` is the leaf's number in the scene,
  /// `curl` its own share of dryness (leaf_look.h).
  std::vector<LeafInstance> leaves;
  std::vector<CardLeaves> ofNode;
  float leafLength = 0;                   ///< m, the longest cluster mean
  float radius = 0;                       ///< m, of all nodes round the tree's foot
  std::vector<std::uint32_t> firstLinks;  ///< of its trees
};

struct CardSet {
  std::vector<CardNode> nodes;
  std::vector<CardInstance> instances;  ///< plant by plant, tree by tree
  std::vector<CardPlant> plants;
  std::vector<std::uint32_t> ofLeaf;  ///< instance of each leaf's cluster; kNoCard: none
};
inline constexpr std::uint32_t kNoCard = 0xffffffffu;

/// Follows from trees, number of leaves and seed alone. Ends early, with nothing, once `stop` is set.
CardSet makeCards(const SceneContent& content, const std::atomic<bool>& stop);

}  // namespace windfall::render
