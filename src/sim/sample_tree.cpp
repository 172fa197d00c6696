#include "sim/sample_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "kernels/random.h"

namespace windfall::sim {

namespace {

constexpr float kGoldenAngle = 2.399963f;
constexpr double kLeafAreaPerSection = 2000;  // total area over the trunk's section (2.4)

/// Grows axes depth first, so that every subtree stays together.
class Grower {
 public:
  explicit Grower(const SampleTreeSettings& settings) : settings_(settings), random_(settings.seed) {}

  Tree grow() {
    tree_.name = "sample tree";
    axis(-1, 0, vec3(0), quat(vec3(-std::numbers::pi_v<float> / 2, 0, 0)), settings_.height, settings_.baseRadius);
    if (settings_.leaves) addLeaves();
    return std::move(tree_);
  }

 private:
  void axis(std::int32_t parent, int order, vec3 start, quat rotation, float length, float baseRadius) {
    const auto rank = static_cast<std::size_t>(order);
    const int segments = settings_.segments[rank];
    const bool last = order + 1 >= settings_.orders;
    const int children = last ? 0 : settings_.children[rank];
    const std::int32_t chain = chains_++;
    const float step = length / static_cast<float>(segments);
    float turn = static_cast<float>(random_.uniform(0, 6.28));
    for (int s = 0; s < segments; ++s) {
      Link link;
      link.parent = parent;
      link.chain = chain;
      link.order = order;
      link.joint = start;
      link.rotation = glm::normalize(rotation);
      link.length = step;
      link.radius = baseRadius * (1 - 0.6f * (static_cast<float>(s) + 0.5f) / static_cast<float>(segments));
      link.youngsModulus = settings_.youngsModulus;
      parent = static_cast<std::int32_t>(tree_.links.size());
      tree_.links.push_back(link);
      if (last) terminal_.push_back({parent, baseRadius * baseRadius / static_cast<float>(segments)});
      for (int c = 0; c < children; ++c) {
        // Side axes stand over the outer three quarters.
        const float along = 0.25f + 0.72f * (static_cast<float>(c) + 0.5f) / static_cast<float>(children);
        const float inside = along * static_cast<float>(segments) - static_cast<float>(s);
        if (inside < 0 || inside >= 1) continue;
        turn += kGoldenAngle;
        const float lean = static_cast<float>(random_.uniform(0.7, 1.2));
        const quat side = rotation * glm::angleAxis(turn, vec3(0, 0, 1)) * glm::angleAxis(lean, vec3(1, 0, 0));
        const float childLength = length * (order == 0 ? 0.45f : 0.4f) * (1.1f - 0.6f * along);
        const float thickness = std::min(0.8f * link.radius, 0.0095f * std::pow(childLength, 1.2f));
        axis(parent, order + 1, start + link.rotation * vec3(0, 0, step * inside), side, childLength, thickness);
      }
      start += link.rotation * vec3(0, 0, step);
      const auto wiggle = [&] { return static_cast<float>(random_.uniform(-0.06, 0.06)); };
      rotation = rotation * quat(vec3(wiggle(), wiggle(), 0));
    }
  }

  void addLeaves() {
    const double base = static_cast<double>(settings_.baseRadius);
    const double total = kLeafAreaPerSection * std::numbers::pi * base * base;
    double sum = 0;
    for (const auto& [link, share] : terminal_) sum += static_cast<double>(share);
    for (const auto& [link, share] : terminal_) {
      Link& body = tree_.links[static_cast<std::size_t>(link)];
      body.leafArea = static_cast<float>(total * static_cast<double>(share) / sum);
      for (int k = 0; k < settings_.sitesPerLink; ++k) {
        LeafSite site;
        site.link = link;
        site.position = vec3(0, 0, body.length * static_cast<float>(random_.uniform()));
        const float around = static_cast<float>(random_.uniform(0, 6.28));
        site.rotation = glm::angleAxis(around, vec3(0, 0, 1)) * glm::angleAxis(0.5f, vec3(1, 0, 0));
        tree_.sites.push_back(site);
      }
    }
  }

  struct Terminal {
    std::int32_t link;
    float share;
  };
  const SampleTreeSettings& settings_;
  RandomSequence random_;
  Tree tree_;
  std::vector<Terminal> terminal_;
  std::int32_t chains_ = 0;
};

}  // namespace

Tree sampleTree(const SampleTreeSettings& settings) { return Grower(settings).grow(); }

SampleTreeSettings tenThousandLinks() {
  SampleTreeSettings settings;
  settings.children = {24, 14, 8};
  return settings;
}

SampleTreeSettings broadleafOf(std::size_t links) {
  SampleTreeSettings settings;
  settings.sitesPerLink = 0;
  if (links <= 1'000) {
    settings.children = {10, 6, 4};
  } else if (links <= 10'000) {
    settings.children = {24, 14, 8};
  } else {
    settings.segments = {20, 12, 8, 4};
    settings.children = links <= 100'000 ? std::array{55, 30, 13} : std::array{184, 76, 16};
  }
  return settings;
}

SampleTreeSettings coniferOf(std::size_t links) {
  SampleTreeSettings settings;
  settings.sitesPerLink = 0;
  settings.orders = 3;
  settings.segments = {300, 10, 3, 1};
  if (links <= 10'000) {
    settings.children = {300, 7, 0};
  } else {
    settings.children = links <= 100'000 ? std::array{1500, 19, 0} : std::array{6000, 52, 0};
  }
  return settings;
}

Tree cantilever(int links, float length, float radius, bool standing) {
  Tree tree;
  tree.name = "cantilever";
  const float half = std::numbers::pi_v<float> / 2;
  const quat turn = standing ? glm::angleAxis(-half, vec3(1, 0, 0)) : glm::angleAxis(half, vec3(0, 1, 0));
  const float step = length / static_cast<float>(links);
  for (int i = 0; i < links; ++i) {
    Link link;
    link.parent = i - 1;
    link.rotation = turn;
    link.joint = turn * vec3(0, 0, step * static_cast<float>(i));
    link.length = step;
    link.radius = radius;
    tree.links.push_back(link);
  }
  return tree;
}

}  // namespace windfall::sim
