// A stiff tree of one link with leaf sites, and what a LeafField needs to run without the tree solver.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "kernels/link_state.h"
#include "kernels/wind.h"
#include "sim/engine.h"
#include "sim/leaf_field.h"

namespace windfall::test {

/// A pole of 4 m with `sites` leaves hanging at its top.
inline std::shared_ptr<const sim::Tree> poleWithLeaves(int sites) {
  auto tree = std::make_shared<sim::Tree>();
  sim::Link link;
  link.rotation = quat(0.70710678f, -0.70710678f, 0, 0);  // local z is up
  link.length = 4;
  link.radius = 0.05f;
  link.leafArea = 0.003f * static_cast<float>(sites);
  tree->links.push_back(link);
  for (int k = 0; k < sites; ++k) {
    sim::LeafSite site;
    site.position = vec3(0.1f, 0, 3.0f + 0.8f * static_cast<float>(k) / static_cast<float>(sites));
    // The blade hangs, its upper face outwards: tip along the link's -z, face along its x.
    site.rotation = quat(0.5f, 0.5f, 0.5f, 0.5f) * quat(0.70710678f, 0, 0, -0.70710678f);
    site.layer = static_cast<std::uint32_t>(k) % 3u;
    tree->sites.push_back(site);
  }
  return tree;
}

/// Leaves of a scene and one link's state to drive them with.
class LeafStage {
 public:
  explicit LeafStage(const sim::SceneDescription& scene) : field(scene) {
    for (const sim::TreeInstance& instance : scene.trees) {
      for (const sim::Link& link : instance.tree->links) {
        LinkState state;
        state.rotation = {link.rotation.x, link.rotation.y, link.rotation.z, link.rotation.w};
        state.position = instance.placement.position + link.joint;
        before.push_back(state);
      }
    }
    now = before;
  }
  LinkView links() const { return {before.data(), now.data(), static_cast<std::uint32_t>(now.size())}; }
  /// Uniform wind, m/s.
  WindView wind() const {
    WindView view;
    view.velocity = air.data();
    view.nx = view.ny = view.nz = 2;
    return view;
  }
  void blow(vec3 velocity) { air.assign(8, vec4(velocity, 0)); }
  void step(float dt = 1.0f / 60) {
    field.step(time, dt, links(), wind());
    time += static_cast<double>(dt);
  }
  std::vector<LeafInstance> show(float alpha) const {
    std::vector<LeafInstance> leaves(field.size());
    field.write(alpha, links(), leaves);
    return leaves;
  }

  sim::LeafField field;
  std::vector<LinkState> before, now;
  std::vector<vec4> air = std::vector<vec4>(8, vec4(0));
  double time = 0;
};

/// Loose leaves at a height; the mass gives a median terminal speed of 1.15 m/s, as in the method's Monte Carlo.
inline sim::SceneDescription looseLeaves(int count, float height, std::uint64_t seed = 1) {
  sim::SceneDescription scene;
  scene.leaves.count = count;
  scene.leaves.spawnHeight = height;
  scene.leaves.massPerArea = 0.0946f;
  scene.seed = seed;
  return scene;
}

inline sim::SceneDescription leavesOnPole(int count, float season, int sites = 500, std::uint64_t seed = 1) {
  sim::SceneDescription scene;
  scene.trees.push_back({poleWithLeaves(sites), {}});
  scene.leaves.count = count;
  scene.leaves.season = season;
  scene.seed = seed;
  return scene;
}

}  // namespace windfall::test
