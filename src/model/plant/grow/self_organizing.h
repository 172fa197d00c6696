// Self-organizing growth: buds compete for light, axes share vigour (growers.md, 2).
#pragma once

#include "model/plant/grow/colonization.h"

namespace windfall::model::growth {

/// Richards' growth curve: height at `years` of a plant that ends at `height`.
double grownHeight(const SelfOrganizingSettings& settings, double height, double years);

struct SelfOrganized {
  Grown grown;        ///< axes set, radii not; `birth` counts years
  int made = 0;       ///< metamers ever made
  bool full = false;  ///< the limit of nodes stopped it
};

/// `years` whole years of growth; `events` (in order of time) happen at the start of their year.
SelfOrganized selfOrganize(const SelfOrganizingSettings& settings, double height, int years, quint64 seed,
                           const std::vector<GrowthEvent>& events, Progress& progress);

/// Shares of `vigour` by the extended Borchert-Honda rule: first the main part, then the lateral one (2.2).
struct VigourShares {
  double main = 0, lateral = 0;
};
VigourShares borchertHonda(double vigour, double mainLight, double lateralLight, double lambda);

/// What an axis feeds: light and number of buds of an item, and its place among the others after sorting.
struct AxisItem {
  double light = 0;
  double buds = 0;
  bool terminal = false;
};
/// Shares of `vigour` by the priority rule, in the order of `items` (base to tip) (2.2).
std::vector<double> byPriority(double vigour, const std::vector<AxisItem>& items,
                               const SelfOrganizingSettings& settings);

}  // namespace windfall::model::growth
