#include <algorithm>
#include <cmath>

#include "model/plant/links_private.h"

namespace windfall::model {

void makeSelfSupporting(sim::Tree& tree) {
  constexpr double kGravity = 9.81, kPi = 3.14159265358979;
  constexpr double kGreenhill = 7.837;  ///< critical load of a column: m g L^2 = 7.837 E I (Greenhill 1881)
  constexpr double kShare = 1.0 / 8;    ///< of it that a link may carry
  std::vector<double> mass(tree.links.size(), 0), reach(tree.links.size(), 0);
  for (std::size_t i = tree.links.size(); i-- > 0;) {
    sim::Link& link = tree.links[i];
    const auto ownMass = [&] {
      const sim::LinkMass own = sim::massOf(link);
      return static_cast<double>(own.wood) + static_cast<double>(own.leaves);
    };
    reach[i] += static_cast<double>(link.length);
    // A stouter link is heavier too: twice is enough, since its own mass is a small part of what it carries.
    for (int round = 0; round < 2; ++round) {
      const double load = (mass[i] + ownMass()) * kGravity * reach[i] * reach[i];
      const double inertia = load / (kShare * kGreenhill * static_cast<double>(link.youngsModulus));
      link.radius = std::max(link.radius, static_cast<float>(std::pow(4 * inertia / kPi, 0.25)));
    }
    mass[i] += ownMass();
    if (link.parent < 0) continue;
    const auto parent = static_cast<std::size_t>(link.parent);
    mass[parent] += mass[i];
    reach[parent] = std::max(reach[parent], reach[i]);
    tree.links[parent].radius = std::max(tree.links[parent].radius, link.radius);
  }
}

}  // namespace windfall::model
