// Leaves of a tree are grouped for cards: all of them, near one another, on a joint that carries them.
#include "sim/leaf_clusters.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <set>

#include "kernels/random.h"
#include "sim/leaf_sites.h"

using namespace windfall;
using namespace windfall::sim;

namespace {

/// A trunk of three links with limbs of four links each, and leaves all along them.
Tree leafyTree(int limbs, int leavesALink) {
  Tree tree;
  RandomSequence random(5);
  const auto add = [&](std::int32_t parent, vec3 joint, quat turn, float length) {
    Link link;
    link.parent = parent;
    link.joint = joint;
    link.rotation = turn;
    link.length = length;
    tree.links.push_back(link);
    return static_cast<std::int32_t>(tree.links.size()) - 1;
  };
  const quat up(0.70710678f, -0.70710678f, 0, 0);
  std::int32_t trunk = -1;
  for (int t = 0; t < 3; ++t) {
    trunk = add(trunk, {0, 2.0f * static_cast<float>(t), 0}, up, 2);
    for (int l = 0; l < limbs; ++l) {
      const float angle = 6.2831853f * static_cast<float>(l) / static_cast<float>(limbs) + static_cast<float>(t);
      const quat turn = glm::angleAxis(angle, vec3(0, 1, 0));
      std::int32_t parent = trunk;
      for (int k = 0; k < 4; ++k) {
        const float from = 0.6f * static_cast<float>(k);
        parent = add(parent, vec3(0, 2.0f * static_cast<float>(t) + 1.5f, 0) + turn * vec3(0, 0, from), turn, 0.6f);
        for (int i = 0; i < leavesALink; ++i) {
          LeafSite site;
          site.link = parent;
          site.position = vec3(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(0, 0.6));
          tree.sites.push_back(site);
        }
      }
    }
  }
  return tree;
}

bool carries(const Tree& tree, std::int32_t link, std::int32_t leaf) {
  while (leaf > link) leaf = tree.links[static_cast<std::size_t>(leaf)].parent;
  return leaf == link;
}

}  // namespace

TEST_CASE("every leaf has a cluster that reaches it and hangs on a joint that carries it") {
  const Tree tree = leafyTree(9, 11);
  const LeafClusters clusters = clusterLeaves(tree);
  REQUIRE(clusters.ofSite.size() == tree.sites.size());
  CHECK(clusters.boughs >= 2);
  CHECK(clusters.nodes.size() > 4 * clusters.boughs);
  CHECK(clusters.nodes.size() <= ClusterLimits().most);
  std::vector<int> leaves(clusters.nodes.size(), 0);
  for (std::size_t i = 0; i < tree.sites.size(); ++i) {
    REQUIRE(clusters.ofSite[i] < clusters.nodes.size());
    const LeafCluster& cluster = clusters.nodes[clusters.ofSite[i]];
    ++leaves[clusters.ofSite[i]];
    REQUIRE(cluster.parent >= 0);
    const LeafCluster& bough = clusters.nodes[static_cast<std::size_t>(cluster.parent)];
    const LeafSite& site = tree.sites[i];
    const Link& link = tree.links[static_cast<std::size_t>(site.link)];
    for (const float along : {0.0f, site.size}) {
      const vec3 place = link.joint + link.rotation * (site.position + site.rotation * vec3(0, along, 0));
      CHECK(glm::distance(place, cluster.center) <= cluster.radius);
      CHECK(glm::distance(place, bough.center) <= bough.radius);
    }
    CHECK(carries(tree, cluster.link, site.link));
    CHECK(carries(tree, bough.link, cluster.link));
  }
  for (std::size_t n = clusters.boughs; n < clusters.nodes.size(); ++n) CHECK(leaves[n] > 0);
  for (std::uint32_t b = 0; b < clusters.boughs; ++b) {
    const LeafCluster& bough = clusters.nodes[b];
    CHECK(bough.parent == -1);
    CHECK(bough.childCount > 0);
    for (std::uint32_t k = 0; k < bough.childCount; ++k) {
      CHECK(clusters.nodes[bough.firstChild + k].parent == static_cast<std::int32_t>(b));
    }
  }
}

TEST_CASE("clusters follow from the tree alone and keep their number within the limit") {
  const Tree tree = leafyTree(12, 40);
  const LeafClusters one = clusterLeaves(tree), two = clusterLeaves(tree);
  CHECK(one.ofSite == two.ofSite);
  CHECK(one.nodes.size() == two.nodes.size());
  ClusterLimits few;
  few.most = 20;
  const LeafClusters coarse = clusterLeaves(tree, few);
  CHECK(coarse.nodes.size() <= 20);
  CHECK(coarse.nodes.size() >= 4);
  // A tree on several feet is one tree still.
  Tree stools;
  for (int i = 0; i < 500; ++i) {
    Link link;
    link.joint = vec3(0.01f * static_cast<float>(i), 0, 0);
    link.length = 1;
    stools.links.push_back(link);
    LeafSite site;
    site.link = i;
    stools.sites.push_back(site);
  }
  CHECK(clusterLeaves(stools).nodes.size() <= ClusterLimits().most);
  CHECK(clusterLeaves(Tree()).nodes.empty());
}

TEST_CASE("leaves know the tree and the site that they hang on") {
  const auto tree = std::make_shared<Tree>(leafyTree(4, 3));
  const std::vector<TreeInstance> trees{{tree, {}}, {tree, {}}};
  for (const std::uint32_t count : {50u, 1000u}) {
    for (const LeafPlace& place : chooseSites(trees, count, 3)) {
      REQUIRE(place.tree < 2);
      REQUIRE(place.place < tree->sites.size());
      const auto link = static_cast<std::uint32_t>(tree->sites[place.place].link);
      CHECK(place.link == place.tree * tree->links.size() + link);
    }
  }
}
