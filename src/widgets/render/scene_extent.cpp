#include "widgets/render/scene_extent.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace windfall::render {

namespace {

constexpr std::size_t kLeafSamples = 64;
constexpr float kLargestRadius = 120;  // m; beyond, shadows would be blots
constexpr float kLeafReach = 1.35f;    // leaves may widen the sphere around the trees by this much
constexpr float kStep = 1.15f;         // the radius grows by these steps

}  // namespace

void SceneExtent::update(const TreePass& trees, const FrameSlot& slot) {
  canopies_.clear();
  Bounds standing;
  for (const TreeDraw& tree : trees.trees()) {
    const Bounds& rest = trees.bounds(tree.mesh);
    if (tree.linkCount == 0 || rest.empty()) continue;
    const mat4 root = slot.bones[tree.firstLink];
    Bounds placed;
    for (int corner = 0; corner < 8; ++corner) {
      const vec3 at((corner & 1) != 0 ? rest.upper.x : rest.lower.x, (corner & 2) != 0 ? rest.upper.y : rest.lower.y,
                    (corner & 4) != 0 ? rest.upper.z : rest.lower.z);
      placed.add(vec3(root * vec4(at, 1)));
    }
    standing.add(placed.lower);
    standing.add(placed.upper);
    const vec3 size = placed.upper - placed.lower;
    const float bottom = placed.lower.y + 0.28f * size.y, top = placed.upper.y + 0.03f * size.y;
    // Width of the mean of both sides, less what single branches reach out.
    canopies_.push_back({vec3(0.5f * (placed.lower.x + placed.upper.x), 0.5f * (bottom + top),
                              0.5f * (placed.lower.z + placed.upper.z)),
                         std::max(0.1f, 0.25f * (size.x + size.z) * 0.95f), std::max(0.1f, 0.5f * (top - bottom))});
  }
  Bounds all = standing;
  const float reach =
      standing.empty() ? kLargestRadius : kLeafReach * 0.5f * glm::length(standing.upper - standing.lower);
  const vec3 middle = standing.empty() ? vec3(0) : 0.5f * (standing.lower + standing.upper);
  const std::size_t stride = std::max<std::size_t>(1, slot.leaves.size() / kLeafSamples);
  for (std::size_t i = 0; i < slot.leaves.size(); i += stride) {
    const LeafInstance& leaf = slot.leaves[i];
    const vec3 at = leaf.position;
    if (leaf.state == static_cast<std::uint32_t>(LeafState::Hidden) || glm::length(at - middle) > reach) continue;
    all.add(at - vec3(leaf.size));
    all.add(at + vec3(leaf.size));
  }
  if (all.empty()) return;
  if (!bounds_.empty() && glm::all(glm::greaterThanEqual(all.lower, bounds_.lower)) &&
      glm::all(glm::lessThanEqual(all.upper, bounds_.upper))) {
    return;
  }
  bounds_.add(all.lower);
  bounds_.add(all.upper);
  center_ = 0.5f * (bounds_.lower + bounds_.upper);
  const float needed = std::clamp(0.5f * glm::length(bounds_.upper - bounds_.lower) * 1.02f, 0.5f, kLargestRadius);
  radius_ = std::min(kLargestRadius, std::pow(kStep, std::ceil(std::log(needed) / std::log(kStep))));
}

}  // namespace windfall::render
