#include "model/plant/live_edits.h"

#include <algorithm>

#include "sim/link_limits.h"

namespace windfall::model {

namespace {

/// Times the stiffness of a locked joint: it bends less than can be seen in any storm, and single precision still
/// resolves its neighbours.
constexpr float kLocked = 3000;

void setAttributes(sim::Link& link, const LinkAttributes& attributes) {
  link.stiffnessScale = static_cast<float>(attributes.stiffness);
  link.dampingScale = static_cast<float>(attributes.damping);
  link.windScale = static_cast<float>(attributes.windResponse);
  link.woodDensity = static_cast<float>(attributes.woodDensity);
  link.youngsModulus = static_cast<float>(attributes.youngsModulus);
  link.rayleighAlpha = static_cast<float>(attributes.rayleighAlpha);
  link.rayleighBeta = static_cast<float>(attributes.rayleighBeta);
  link.propagation = static_cast<float>(attributes.propagation);
}

}  // namespace

void applyEdits(sim::Tree& tree, const PlantGeometry& geometry, const std::vector<int>& boneOfLink,
                const std::map<QString, LinkAttributes>& edits) {
  const std::size_t count = std::min(tree.links.size(), boneOfLink.size());
  std::vector<char> locked(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto edit = edits.find(geometry.bones[static_cast<std::size_t>(boneOfLink[i])].name);
    const LinkAttributes attributes = edit == edits.end() ? LinkAttributes{} : edit->second;
    setAttributes(tree.links[i], attributes);
    locked[i] = attributes.pinned;
    if (attributes.pinned) tree.links[i].windScale = 0;
  }
  for (std::size_t i = count; i-- > 0;) {
    if (!locked[i]) continue;
    float& stiffness = tree.links[i].stiffnessScale;
    stiffness = std::min(stiffness * kLocked, std::max(stiffness, sim::kLargestFactor));
    if (tree.links[i].parent >= 0) locked[static_cast<std::size_t>(tree.links[i].parent)] = 1;
  }
}

std::shared_ptr<const sim::Tree> withEdits(const sim::Tree& tree, const PlantGeometry& geometry,
                                           const PlantBodies& bodies, const std::map<QString, LinkAttributes>& edits) {
  auto edited = std::make_shared<sim::Tree>(tree);
  applyEdits(*edited, geometry, bodies.boneOfLink, edits);
  return edited;
}

}  // namespace windfall::model
