#include "widgets/render/card_set.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "kernels/leaf_look.h"
#include "kernels/random.h"
#include "sim/engine.h"
#include "sim/leaf_clusters.h"
#include "sim/leaf_sites.h"

namespace windfall::render {

namespace {

constexpr float kTau = 6.2831853f;
constexpr float kSwitchPixels = 3.5f;                         // of a leaf where cards usually begin
constexpr std::size_t kPictureBytes = std::size_t{40} << 20;  // of a plant's colours and surfaces

vec3 direction(float azimuth, float elevation) {
  return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), std::cos(azimuth) * std::cos(elevation)};
}

/// So many pixels that a picture is as fine as the screen where its card takes over.
int tileOf(const std::vector<CardNode>& nodes, const CardPlant& plant) {
  std::vector<float> wanted;
  for (std::size_t i = plant.boughs; i < plant.nodeCount; ++i) {
    const CardNode& node = nodes[plant.firstNode + i];
    if (node.spread.w > 0) wanted.push_back(2 * node.sphere.w / node.spread.w * kSwitchPixels);
  }
  if (wanted.empty()) return 32;
  const auto middle = wanted.begin() + static_cast<std::ptrdiff_t>(wanted.size() * 3 / 4);
  std::nth_element(wanted.begin(), middle, wanted.end());
  const std::size_t layers = plant.nodeCount * kCardViews;
  int tile = 32;
  // Multiples of 16, so that four halvings meet no neighbour.
  while (tile < 96 && static_cast<float>(tile) < *middle) tile += 16;
  while (tile > 32 && static_cast<std::size_t>(tile) * static_cast<std::size_t>(tile) * layers * 8 > kPictureBytes)
    tile -= 16;
  return tile;
}

LeafInstance restLeaf(const sim::LeafPlace& place, const sim::Tree& tree, std::uint32_t leaf, std::uint64_t seed) {
  const sim::LeafSite& site = place.site;
  const sim::Link& link = tree.links[static_cast<std::size_t>(site.link)];
  const quat turn = glm::normalize(link.rotation * site.rotation);
  const std::uint32_t look = hash(seed, leaf);
  LeafInstance instance{};
  instance.position = link.joint + link.rotation * site.position;
  instance.size = site.size;
  instance.rotation = {turn.x, turn.y, turn.z, turn.w};
  instance.layer = site.layer;
  instance.state = leaf;
  instance.curl = leafOwn(look);
  instance.tint = leafTint(look);
  return instance;
}

/// What a node's leaves come to; `leaves` lie in its range.
void measure(const CardPlant& plant, std::size_t local, CardNode& node) {
  const CardLeaves range = plant.ofNode[local];
  double area = 0, length = 0, q[6]{};
  for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
    const LeafInstance& leaf = plant.leaves[i];
    const quat turn(leaf.rotation.w, leaf.rotation.x, leaf.rotation.y, leaf.rotation.z);
    const vec3 n = turn * vec3(0, 0, 1);
    const auto weight = static_cast<double>(leaf.size * leaf.size);
    area += weight;
    length += weight * static_cast<double>(leaf.size);
    const float products[] = {n.x * n.x, n.y * n.y, n.z * n.z, n.x * n.y, n.x * n.z, n.y * n.z};
    for (int k = 0; k < 6; ++k) q[k] += weight * static_cast<double>(products[k]);
  }
  if (!(area > 0)) return;
  node.picture.y = plant.leaves[range.first].layer;
  node.spread = vec4(q[0] / area, q[1] / area, q[2] / area, length / area);
  node.spreadAndArea = vec4(q[3] / area, q[4] / area, q[5] / area, area);
}

/// Leaves of the plant's first tree, cluster by cluster.
void collectLeaves(CardPlant& plant, std::vector<CardNode>& nodes, const sim::LeafClusters& clusters,
                   const sim::Tree& tree, const std::vector<sim::LeafPlace>& places, std::uint32_t instanceTree,
                   std::uint64_t seed) {
  std::vector<std::vector<LeafInstance>> ofCluster(plant.nodeCount);
  const auto first = std::lower_bound(places.begin(), places.end(), instanceTree,
                                      [](const sim::LeafPlace& p, std::uint32_t t) { return p.tree < t; });
  for (auto it = first; it != places.end() && it->tree == instanceTree; ++it) {
    ofCluster[clusters.ofSite[it->place]].push_back(
        restLeaf(*it, tree, static_cast<std::uint32_t>(it - places.begin()), seed));
  }
  plant.ofNode.resize(plant.nodeCount);
  for (std::size_t i = plant.boughs; i < plant.nodeCount; ++i) {
    plant.ofNode[i] = {static_cast<std::uint32_t>(plant.leaves.size()),
                       static_cast<std::uint32_t>(ofCluster[i].size())};
    plant.leaves.insert(plant.leaves.end(), ofCluster[i].begin(), ofCluster[i].end());
  }
  for (std::size_t b = 0; b < plant.boughs; ++b) {
    const sim::LeafCluster& bough = clusters.nodes[b];
    plant.ofNode[b].first = plant.ofNode[bough.firstChild].first;
    for (std::uint32_t k = 0; k < bough.childCount; ++k)
      plant.ofNode[b].count += plant.ofNode[bough.firstChild + k].count;
  }
  for (std::size_t i = 0; i < plant.nodeCount; ++i) {
    CardNode& node = nodes[plant.firstNode + i];
    measure(plant, i, node);
    plant.leafLength = std::max(plant.leafLength, node.spread.w);
    plant.radius = std::max(plant.radius, glm::length(vec3(node.sphere)) + node.sphere.w);
  }
}

}  // namespace

vec3 cardView(std::size_t view) {
  if (view < 6) return direction(kTau * static_cast<float>(view) / 6, 0.13f);
  if (view < 9) return direction(kTau * (static_cast<float>(view - 6) + 0.5f) / 3, 0.84f);
  return {0, 1, 0};
}

CardSet makeCards(const SceneContent& content, const std::atomic<bool>& stop) {
  CardSet set;
  std::vector<sim::TreeInstance> trees;
  std::size_t sites = 0;
  for (const auto& tree : content.leafTrees) {
    trees.push_back({tree, {}});
    sites += tree->sites.size();
  }
  if (sites == 0 || content.leafCount == 0 || trees.size() != content.trees.size()) return set;
  const auto count = static_cast<std::uint32_t>(content.leafCount);
  const std::vector<sim::LeafPlace> places = sim::chooseSites(trees, count, content.leafSeed);
  sim::ClusterLimits limits;
  limits.sites *= static_cast<double>(sites) / static_cast<double>(count);

  std::map<const sim::Tree*, std::vector<std::uint32_t>> kinds;
  std::vector<const sim::Tree*> order;
  for (std::uint32_t t = 0; t < trees.size(); ++t) {
    const sim::Tree* tree = trees[t].tree.get();
    if (tree->sites.empty()) continue;
    if (kinds[tree].empty()) order.push_back(tree);
    kinds[tree].push_back(t);
  }
  std::vector<std::uint32_t> firstInstance(trees.size(), kNoCard);
  std::vector<sim::LeafClusters> clusters;
  std::vector<std::size_t> kindOf(trees.size(), 0);
  for (const sim::Tree* tree : order) {
    if (stop) return {};
    clusters.push_back(sim::clusterLeaves(*tree, limits));
    const sim::LeafClusters& made = clusters.back();
    CardPlant plant;
    plant.firstNode = static_cast<std::uint32_t>(set.nodes.size());
    plant.nodeCount = static_cast<std::uint32_t>(made.nodes.size());
    plant.boughs = made.boughs;
    for (std::uint32_t i = 0; i < plant.nodeCount; ++i) {
      const sim::LeafCluster& cluster = made.nodes[i];
      CardNode node;
      node.sphere = vec4(cluster.center, cluster.radius);
      node.place = {cluster.link, cluster.parent, static_cast<int>(cluster.firstChild),
                    static_cast<int>(cluster.childCount)};
      node.picture.x = i * static_cast<std::uint32_t>(kCardViews);
      set.nodes.push_back(node);
    }
    collectLeaves(plant, set.nodes, made, *tree, places, kinds[tree].front(), content.leafSeed);
    plant.tile = tileOf(set.nodes, plant);
    plant.firstInstance = static_cast<std::uint32_t>(set.instances.size());
    for (const std::uint32_t t : kinds[tree]) {
      firstInstance[t] = static_cast<std::uint32_t>(set.instances.size());
      kindOf[t] = clusters.size() - 1;
      plant.firstLinks.push_back(content.trees[t].firstLink);
      for (std::uint32_t i = 0; i < plant.nodeCount; ++i) {
        set.instances.push_back({plant.firstNode + i, content.trees[t].firstLink});
      }
    }
    plant.instanceCount = static_cast<std::uint32_t>(set.instances.size()) - plant.firstInstance;
    set.plants.push_back(std::move(plant));
  }
  set.ofLeaf.assign(count, kNoCard);
  for (std::uint32_t leaf = 0; leaf < places.size(); ++leaf) {
    const sim::LeafPlace& place = places[leaf];
    set.ofLeaf[leaf] = firstInstance[place.tree] + clusters[kindOf[place.tree]].ofSite[place.place];
  }
  return set;
}

}  // namespace windfall::render
