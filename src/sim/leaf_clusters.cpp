#include "sim/leaf_clusters.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace windfall::sim {

namespace {

constexpr float kBladeReach = 0.62f;   // of a leaf's length from its middle, bent and broad ones too
constexpr double kBoughClusters = 12;  // in a bough, at most
constexpr float kBoughReach = 3.2f;    // half a bough's size in those of clusters
constexpr float kRaise = 1.25f;        // of the limits, where there would be too many clusters

/// What is grouped: a leaf, or a cluster.
struct Item {
  vec3 center{0};
  float radius = 0;
  std::int32_t link = 0;
};

struct Box {
  vec3 lower{std::numeric_limits<float>::max()}, upper{-std::numeric_limits<float>::max()};
  void add(const Item& item) {
    lower = glm::min(lower, item.center);
    upper = glm::max(upper, item.center);
  }
  void add(const Box& box) {
    lower = glm::min(lower, box.lower);
    upper = glm::max(upper, box.upper);
  }
};

struct Limits {
  double count = 1;
  float reach = 1;
  bool fits(std::size_t items, const Box& box) const {
    return items <= 1 || (static_cast<double>(items) <= count && 0.5f * glm::length(box.upper - box.lower) <= reach);
  }
};

struct Group {
  std::vector<std::uint32_t> items;
  std::int32_t link = 0;
};

class Grouping {
 public:
  Grouping(const std::vector<Link>& links, const std::vector<Item>& items, const Limits& limits)
      : links_(links), items_(items), limits_(limits) {}

  /// From the tips down: what has gathered below a joint and is too much for one group is parted there.
  std::vector<Group> run() {
    const std::size_t count = links_.size();
    std::vector<std::vector<std::uint32_t>> gathered(count);
    for (std::uint32_t i = 0; i < items_.size(); ++i) gathered[static_cast<std::size_t>(items_[i].link)].push_back(i);
    std::vector<std::uint32_t> rest;
    for (std::size_t link = count; link-- > 0;) {
      std::vector<std::uint32_t>& here = gathered[link];
      if (here.empty()) continue;
      const std::int32_t parent = links_[link].parent;
      if (!limits_.fits(here.size(), boxOf(here.data(), here.size()))) {
        part(here.data(), here.size());
        continue;
      }
      std::vector<std::uint32_t>& below = parent < 0 ? rest : gathered[static_cast<std::size_t>(parent)];
      if (below.size() < here.size()) below.swap(here);
      below.insert(below.end(), here.begin(), here.end());
      here = {};
    }
    if (!rest.empty()) part(rest.data(), rest.size());
    return std::move(groups_);
  }

 private:
  Box boxOf(const std::uint32_t* first, std::size_t count) const {
    Box box;
    for (std::size_t i = 0; i < count; ++i) box.add(items_[first[i]]);
    return box;
  }

  void part(std::uint32_t* first, std::size_t count) {
    const Box box = boxOf(first, count);
    if (limits_.fits(count, box)) {
      Group group{{first, first + count}, items_[*first].link};
      std::sort(group.items.begin(), group.items.end());
      for (const std::uint32_t item : group.items) group.link = common(group.link, items_[item].link);
      groups_.push_back(std::move(group));
      return;
    }
    const vec3 size = box.upper - box.lower;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::uint32_t* middle = first + count / 2;
    std::nth_element(first, middle, first + count, [&](std::uint32_t a, std::uint32_t b) {
      const float left = items_[a].center[axis], right = items_[b].center[axis];
      return left != right ? left < right : a < b;
    });
    part(first, count / 2);
    part(middle, count - count / 2);
  }

  std::int32_t common(std::int32_t a, std::int32_t b) const {
    std::int32_t x = a, y = b;
    while (x != y && x >= 0 && y >= 0) {
      std::int32_t& later = x > y ? x : y;
      later = links_[static_cast<std::size_t>(later)].parent;
    }
    return x == y ? x : a;  // links of two trees in one stand on the ground
  }

  const std::vector<Link>& links_;
  const std::vector<Item>& items_;
  Limits limits_;
  std::vector<Group> groups_;
};

LeafCluster clusterOf(const Group& group, const std::vector<Item>& items) {
  LeafCluster cluster;
  cluster.link = group.link;
  Box box;
  for (const std::uint32_t item : group.items) box.add(items[item]);
  cluster.center = 0.5f * (box.lower + box.upper);
  for (const std::uint32_t item : group.items) {
    cluster.radius = std::max(cluster.radius, glm::distance(cluster.center, items[item].center) + items[item].radius);
  }
  return cluster;
}

std::vector<Item> itemsOf(const Tree& tree) {
  std::vector<Item> items;
  items.reserve(tree.sites.size());
  for (const LeafSite& site : tree.sites) {
    const Link& link = tree.links[static_cast<std::size_t>(site.link)];
    const vec3 middle = site.position + site.rotation * vec3(0, 0.5f * site.size, 0);
    items.push_back({link.joint + link.rotation * middle, kBladeReach * site.size, site.link});
  }
  return items;
}

}  // namespace

LeafClusters clusterLeaves(const Tree& tree, const ClusterLimits& limits) {
  LeafClusters result;
  if (tree.sites.empty() || tree.links.empty()) return result;
  const std::vector<Item> leaves = itemsOf(tree);
  double length = 0;
  for (const LeafSite& site : tree.sites) length += static_cast<double>(site.size);
  length /= static_cast<double>(tree.sites.size());

  Limits fine{std::max(1.0, limits.sites), limits.reach * static_cast<float>(length)};
  std::vector<Group> clusters, boughs;
  std::vector<Item> items;
  do {
    clusters = Grouping(tree.links, leaves, fine).run();
    items.clear();
    for (const Group& group : clusters) {
      const LeafCluster cluster = clusterOf(group, leaves);
      items.push_back({cluster.center, cluster.radius, cluster.link});
    }
    boughs = Grouping(tree.links, items, {kBoughClusters, kBoughReach * fine.reach}).run();
    fine.count *= static_cast<double>(kRaise);
    fine.reach *= kRaise;
  } while (clusters.size() + boughs.size() > std::max<std::size_t>(2, limits.most));

  result.boughs = static_cast<std::uint32_t>(boughs.size());
  for (const Group& bough : boughs) result.nodes.push_back(clusterOf(bough, items));
  result.ofSite.resize(tree.sites.size());
  for (std::uint32_t b = 0; b < result.boughs; ++b) {
    result.nodes[b].firstChild = static_cast<std::uint32_t>(result.nodes.size());
    result.nodes[b].childCount = static_cast<std::uint32_t>(boughs[b].items.size());
    for (const std::uint32_t item : boughs[b].items) {
      for (const std::uint32_t site : clusters[item].items) {
        result.ofSite[site] = static_cast<std::uint32_t>(result.nodes.size());
      }
      LeafCluster cluster = clusterOf(clusters[item], leaves);
      cluster.parent = static_cast<std::int32_t>(b);
      result.nodes.push_back(cluster);
    }
  }
  return result;
}

}  // namespace windfall::sim
