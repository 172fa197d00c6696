// What the window does to a running engine: a hand on a branch, poses from elsewhere, trees that go on in another
// scene.
#include <algorithm>
#include <cmath>

#include "kernels/rotation.h"
#include "sim/cpu_engine.h"

namespace windfall::sim {

void CpuEngine::setPull(const std::optional<Pull>& pull) {
  if (!pull || pull->link >= trees_.size() || !std::isfinite(glm::dot(pull->target, pull->target)) ||
      !std::isfinite(glm::dot(pull->grab, pull->grab))) {
    pull_.release();
    wind_.setPull({});
    return;
  }
  std::size_t instance = 0;
  const std::span<const std::uint32_t> first = trees_.firstLinks();
  while (instance + 1 < first.size() && first[instance + 1] <= pull->link) ++instance;
  const Link& link = scene_.trees[instance].tree->links[pull->link - first[instance]];
  pull_.hold(*pull, link, scene_.trees[instance].placement, trees_);
}

void CpuEngine::adopt(const Engine& before, std::span<const int> from) {
  const auto* other = dynamic_cast<const CpuEngine*>(&before);
  if (other == nullptr || from.size() != scene_.trees.size()) return;
  steps_ = other->steps_;
  accumulator_ = std::min(other->accumulator_, stepLength());
  between_ = 1;
  wind_.restore(other->wind_.anchor());
  for (std::size_t t = 0; t < from.size(); ++t) {
    const auto source = static_cast<std::size_t>(from[t]);
    if (from[t] < 0 || source >= other->scene_.trees.size()) continue;
    const std::size_t count = scene_.trees[t].tree->links.size();
    if (count != other->scene_.trees[source].tree->links.size()) continue;
    const std::size_t own = trees_.firstLinks()[t], theirs = other->trees_.firstLinks()[source];
    for (std::size_t i = 0; i < count; ++i) {
      trees_.setJoint(own + i, other->trees_.angle(theirs + i), other->trees_.speed(theirs + i));
    }
  }
  trees_.pose();
  takeWind();
  wind_.advance(time());
}

void CpuEngine::writePosed(std::span<const mat4> pose, std::span<mat4> boneMatrices, std::span<LeafInstance> leaves) {
  const std::size_t count = std::min({pose.size(), boneMatrices.size(), trees_.size()});
  std::copy_n(pose.begin(), count, boneMatrices.begin());
  if (leaves.size() != leaves_.size() || count != trees_.size()) return;
  std::vector<LinkState> states(count);
  for (std::size_t i = 0; i < count; ++i) {
    const quat turn = glm::quat_cast(mat3(pose[i]));
    const vec4 rest = restRotations_[i];  // inverse of the rest rotation
    states[i].rotation = compose(vec4(turn.x, turn.y, turn.z, turn.w), vec4(-rest.x, -rest.y, -rest.z, rest.w));
    states[i].position = vec3(pose[i] * vec4(restPositions_[i], 1));
  }
  leaves_.write(1, {states.data(), states.data(), static_cast<std::uint32_t>(count)}, leaves);
}

/// A state that was left by trees in other places: its joint angles hold, its places do not.
void CpuEngine::poseWhereMoved() {
  const std::vector<float> motion = trees_.state();
  const std::vector<LinkState> before(trees_.previous().begin(), trees_.previous().end());
  const std::vector<LinkState> after(trees_.current().begin(), trees_.current().end());
  trees_.pose();
  for (const std::uint32_t root : trees_.firstLinks()) {
    if (root >= after.size()) continue;
    const LinkState &own = trees_.current()[root], &saved = after[root];
    const float turned = 1 - std::abs(glm::dot(own.rotation, saved.rotation));
    if (glm::length(own.position - saved.position) > 1e-4f || turned > 1e-6f) return;
  }
  trees_.setState(motion, before, after);
}

}  // namespace windfall::sim
