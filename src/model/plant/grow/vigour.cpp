#include <algorithm>
#include <numeric>

#include "model/plant/grow/self_organizing.h"

namespace windfall::model::growth {

VigourShares borchertHonda(double vigour, double mainLight, double lateralLight, double lambda) {
  const double whole = lambda * mainLight + (1 - lambda) * lateralLight;
  if (!(whole > 0)) return {};
  const double main = vigour * lambda * mainLight / whole;
  return {main, vigour - main};
}

std::vector<double> byPriority(double vigour, const std::vector<AxisItem>& items, const SelfOrganizingSettings& s) {
  std::vector<double> key(items.size(), 0), share(items.size(), 0);
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].buds > 0) key[i] = items[i].light / items[i].buds * (items[i].terminal ? 1 + s.apical : 1);
  }
  std::vector<std::size_t> order(items.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key[a] > key[b]; });
  const double favoured = std::max(1.0, s.favoured * static_cast<double>(items.size()));
  double sum = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const auto r = static_cast<double>(rank);
    const double weight = r < favoured ? 1 - (1 - s.leastWeight) * r / favoured : s.leastWeight;
    share[order[rank]] = weight * items[order[rank]].light;
    sum += share[order[rank]];
  }
  for (double& each : share) each = sum > 0 ? vigour * each / sum : 0;
  return share;
}

}  // namespace windfall::model::growth
