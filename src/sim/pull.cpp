#include "sim/pull.h"

#include <algorithm>
#include <cmath>

#include "sim/tree_field.h"

namespace windfall::sim {

namespace {
constexpr float kDelay = 0.06f;     // s
constexpr float kFeedback = 0.35f;  // of the branch's own stiffness
}  // namespace

vec3 PullForce::placeNow(const TreeField& trees) const { return placeOf(trees.current()[pull_.link], local_); }

void PullForce::hold(const Pull& pull, const Link& link, const Placement& placement, const TreeField& trees) {
  const bool same = held_ && pull.link == pull_.link && pull.grab == pull_.grab;
  pull_ = pull;
  if (same) return;
  held_ = true;
  local_ = glm::conjugate(link.rotation) * (pull.grab - link.joint);
  rest_ = placement.position + glm::angleAxis(placement.heading, vec3(0, 1, 0)) * pull.grab;
  hand_ = placeNow(trees);
  // Every joint on the way down gives by arm^2 / k.
  double compliance = 0;
  for (auto i = static_cast<std::int32_t>(pull.link); i >= 0;) {
    const auto joint = static_cast<std::size_t>(i);
    const vec3 arm = hand_ - trees.current()[joint].position;
    compliance += static_cast<double>(glm::dot(arm, arm) / trees.shape(joint).stiffness.x);
    i = trees.parents()[joint];
  }
  stiffness_ = static_cast<float>(1 / std::max(compliance, 1e-9));
}

LinkPull PullForce::next(const TreeField& trees, float h) {
  hand_ += (pull_.target - hand_) * (1 - std::exp(-h / kDelay));
  const vec3 now = placeNow(trees);
  LinkPull load;
  load.link = static_cast<std::uint32_t>(pull_.link);
  load.force = stiffness_ * ((hand_ - rest_) + kFeedback * (hand_ - now));
  load.arm = now - trees.current()[pull_.link].position;
  return load;
}

}  // namespace windfall::sim
