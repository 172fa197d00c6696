#include "model/plant/bodies.h"

#include <algorithm>
#include <cmath>

#include "kernels/random.h"
#include "model/plant/frames.h"
#include "model/plant/links_private.h"
#include "model/plant/live_edits.h"

namespace windfall::model {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }
constexpr float kGoldenAngle = 2.39996323f;

/// Bones that become links, depth first, each branch before what leaves it.
std::vector<int> preorder(const LinkForest& forest) {
  std::vector<int> order, stack;
  for (std::size_t b = forest.link.size(); b-- > 0;) {
    if (forest.link[b] && forest.parent[b] < 0) stack.push_back(static_cast<int>(b));
  }
  while (!stack.empty()) {
    const int b = stack.back();
    stack.pop_back();
    order.push_back(b);
    const int next = forest.next[at(b)];
    const std::vector<int>& children = forest.children[at(b)];
    for (std::size_t i = children.size(); i-- > 0;) {
      if (children[i] != next) stack.push_back(children[i]);
    }
    if (next >= 0) stack.push_back(next);
  }
  return order;
}

/// The link that moves what hangs on a bone: its own, else of the nearest ancestor, else of the first descendant.
std::vector<int> carriers(const std::vector<Bone>& bones, const std::vector<int>& linkOfBone) {
  std::vector<int> carrier = linkOfBone;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    if (carrier[b] < 0 && bones[b].parent >= 0) carrier[b] = carrier[at(bones[b].parent)];
  }
  for (std::size_t b = bones.size(); b-- > 0;) {
    const int parent = bones[b].parent;
    if (parent >= 0 && carrier[at(parent)] < 0) carrier[at(parent)] = carrier[b];
  }
  return carrier;
}

/// From the bone's frame to that of the link that carries it.
sim::LeafSite onLink(sim::LeafSite site, const Bone& bone, const sim::Link& link) {
  const quat frame = alongZ(bone.tail - bone.head), back = glm::conjugate(link.rotation);
  site.position = back * (bone.head + frame * site.position - link.joint);
  site.rotation = glm::normalize(back * frame * site.rotation);
  return site;
}

/// `density` below 1 keeps a share of the sites, above 1 it repeats them, turned about their link. The order is
/// scattered, so that the first n of them are spread evenly over the tree.
std::vector<sim::LeafSite> thinned(const std::vector<sim::LeafSite>& sites, double density, int firstLayer,
                                   int layers) {
  std::vector<std::pair<std::uint32_t, sim::LeafSite>> drawn;
  const int rounds = static_cast<int>(std::ceil(std::clamp(density, 0.0, 50.0)));
  for (int round = 0; round < rounds; ++round) {
    const double share = std::min(1.0, density - round);
    const quat turn = glm::angleAxis(kGoldenAngle * static_cast<float>(round), vec3(0, 0, 1));
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const auto counter = static_cast<std::uint32_t>(i), copy = static_cast<std::uint32_t>(round);
      if (static_cast<double>(uniform(11, counter, copy, 0)) >= share) continue;
      sim::LeafSite site = sites[i];
      if (round > 0) site.position = turn * site.position, site.rotation = glm::normalize(turn * site.rotation);
      const auto count = static_cast<std::uint32_t>(std::max(layers, 1));
      site.layer = static_cast<std::uint32_t>(firstLayer) + hash(11, counter, copy, 1) % count;
      drawn.emplace_back(hash(11, counter, copy, 2), site);
    }
  }
  std::stable_sort(drawn.begin(), drawn.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<sim::LeafSite> result;
  result.reserve(drawn.size());
  for (const auto& [order, site] : drawn) result.push_back(site);
  return result;
}

/// Shares the tree's leaf area over the links: where the mesh has leaves, by their size and by the section of the wood
/// that feeds them; else over the terminal branches by the square of their base radius, along each by length
/// (tree_dynamics.md, 2.4).
void shareLeafArea(double area, const PlantGeometry& geometry, PlantBodies& bodies) {
  std::vector<double> share(bodies.tree.links.size(), 0);
  if (!geometry.leafSites.empty()) {
    for (const sim::LeafSite& site : geometry.leafSites) {
      const int link = bodies.carrierOfBone[at(site.link)];
      if (link < 0) continue;
      share[at(link)] += std::pow(static_cast<double>(site.size * bodies.tree.links[at(link)].radius), 2);
    }
  } else {
    const std::vector<char> terminal = terminalBranches(bodies.branches);
    for (std::size_t i = 0; i < bodies.branches.size(); ++i) {
      const Branch& branch = bodies.branches[i];
      if (!terminal[i] || !(branch.length > 0)) continue;
      for (const int b : branch.bones) {
        const int link = bodies.linkOfBone[at(b)];
        share[at(link)] += branch.baseRadius * branch.baseRadius *
                           static_cast<double>(bodies.tree.links[at(link)].length) / branch.length;
      }
    }
  }
  double sum = 0;
  for (const double s : share) sum += s;
  if (!(sum > 0)) return;
  for (std::size_t i = 0; i < share.size(); ++i) {
    bodies.tree.links[i].leafArea = static_cast<float>(area * share[i] / sum);
  }
}

}  // namespace

PlantBodies buildBodies(const PlantGeometry& geometry, const Plant& plant, int firstLayer, int layers) {
  const std::vector<Bone>& bones = geometry.bones;
  const LinkForest forest = linkForest(bones);
  PlantBodies bodies;
  bodies.tree.name = plant.name.toStdString();
  bodies.branches = findBranches(bones);
  bodies.boneOfLink = preorder(forest);
  bodies.linkOfBone.assign(bones.size(), -1);
  for (std::size_t i = 0; i < bodies.boneOfLink.size(); ++i) {
    bodies.linkOfBone[at(bodies.boneOfLink[i])] = static_cast<int>(i);
  }
  bodies.carrierOfBone = carriers(bones, bodies.linkOfBone);

  std::vector<int> branchOf(bones.size(), 0);
  for (std::size_t i = 0; i < bodies.branches.size(); ++i) {
    for (const int b : bodies.branches[i].bones) branchOf[at(b)] = static_cast<int>(i);
  }
  for (const int b : bodies.boneOfLink) {
    const Bone& bone = bones[at(b)];
    const int parent = forest.parent[at(b)];
    sim::Link link;
    link.parent = parent < 0 ? -1 : bodies.linkOfBone[at(parent)];
    link.chain = branchOf[at(b)];
    link.order = bodies.branches[at(link.chain)].order;
    link.joint = bone.head;
    link.rotation = alongZ(bone.tail - bone.head);
    link.length = glm::length(bone.tail - bone.head);
    link.radius = bone.radius;
    bodies.tree.links.push_back(link);
  }
  // Before anything is reckoned from lengths and radii.
  mendLinks(bodies);

  // A grower has said where leaves stand: without any the plant is bare.
  const bool bare =
      geometry.leafSites.empty() && plant.file.isEmpty() && plant.grower && plant.grower->method != GrowMethod::Rule;
  const double area = bare ? 0 : naturalLeafArea(bones, bodies.branches);
  shareLeafArea(area * plant.leafDensity, geometry, bodies);
  // Before the artist's edits, so that softer wood bends more instead of growing thicker.
  makeSelfSupporting(bodies.tree);
  applyEdits(bodies.tree, geometry, bodies.boneOfLink, plant.edits);
  const std::vector<sim::LeafSite> natural =
      geometry.leafSites.empty() && !bare ? leafSitesOnTerminals(bones, bodies.branches, area) : geometry.leafSites;
  std::vector<sim::LeafSite> sites;
  for (const sim::LeafSite& site : natural) {
    const int link = bodies.carrierOfBone[at(site.link)];
    if (link < 0) continue;
    sites.push_back(onLink(site, bones[at(site.link)], bodies.tree.links[at(link)]));
    sites.back().link = link;
  }
  bodies.tree.sites = thinned(sites, plant.leafDensity, firstLayer, layers);
  // Giants are thickened beyond all measure, and leaf areas and edits may be no numbers.
  mendLinks(bodies);
  return bodies;
}

}  // namespace windfall::model
