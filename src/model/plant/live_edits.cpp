#include "model/plant/live_edits.h"

#include <algorithm>

namespace windfall::model {

std::shared_ptr<const sim::Tree> withEdits(const sim::Tree& tree, const PlantGeometry& geometry,
                                           const PlantBodies& bodies, const std::map<QString, LinkAttributes>& edits) {
  auto edited = std::make_shared<sim::Tree>(tree);
  const std::size_t count = std::min(edited->links.size(), bodies.boneOfLink.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto edit = edits.find(geometry.bones[static_cast<std::size_t>(bodies.boneOfLink[i])].name);
    const LinkAttributes attributes = edit == edits.end() ? LinkAttributes{} : edit->second;
    sim::Link& link = edited->links[i];
    link.stiffnessScale = static_cast<float>(attributes.stiffness);
    link.dampingScale = static_cast<float>(attributes.damping);
    link.windScale = static_cast<float>(attributes.windResponse);
    link.woodDensity = static_cast<float>(attributes.woodDensity);
    link.youngsModulus = static_cast<float>(attributes.youngsModulus);
  }
  return edited;
}

}  // namespace windfall::model
