#include "model/plant/links_private.h"
#include "sim/tree_repair.h"

namespace windfall::model {

void mendLinks(PlantBodies& bodies) {
  const sim::TreeRepair repair = sim::repairTree(bodies.tree);
  for (const std::string& note : repair.notes) bodies.notes << QString::fromStdString(note);
  if (!repair.reordered) return;
  std::vector<int> now(repair.from.size(), -1), boneOfLink;
  boneOfLink.reserve(repair.from.size());
  for (const std::int32_t old : repair.from) {
    now[static_cast<std::size_t>(old)] = static_cast<int>(boneOfLink.size());
    boneOfLink.push_back(bodies.boneOfLink[static_cast<std::size_t>(old)]);
  }
  bodies.boneOfLink = std::move(boneOfLink);
  for (std::vector<int>* links : {&bodies.linkOfBone, &bodies.carrierOfBone}) {
    for (int& link : *links) {
      if (link >= 0) link = now[static_cast<std::size_t>(link)];
    }
  }
}

}  // namespace windfall::model
