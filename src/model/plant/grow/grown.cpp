#include "model/plant/grow/grown.h"

#include <algorithm>
#include <cmath>

namespace windfall::model::growth {

std::vector<std::vector<int>> childrenOf(const Grown& grown) {
  std::vector<std::vector<int>> children(grown.size());
  for (std::size_t i = 1; i < grown.size(); ++i) children[at(grown.parent[i])].push_back(static_cast<int>(i));
  return children;
}

void keepOnly(Grown& grown, const std::vector<char>& keep) {
  std::vector<int> place(grown.size(), -1);
  std::size_t next = 0;
  for (std::size_t i = 0; i < grown.size(); ++i) {
    if (i > 0 && (!keep[i] || place[at(grown.parent[i])] < 0)) continue;
    place[i] = static_cast<int>(next);
    grown.position[next] = grown.position[i];
    grown.parent[next] = i == 0 ? -1 : place[at(grown.parent[i])];
    grown.radius[next] = grown.radius[i];
    grown.birth[next] = grown.birth[i];
    grown.continues[next] = grown.continues[i];
    grown.source[next] = grown.source[i];
    ++next;
  }
  grown.position.resize(next);
  grown.parent.resize(next);
  grown.radius.resize(next);
  grown.birth.resize(next);
  grown.continues.resize(next);
  grown.source.resize(next);
  std::erase_if(grown.leaves, [&](const GivenLeaf& leaf) { return place[at(leaf.node)] < 0; });
  for (GivenLeaf& leaf : grown.leaves) leaf.node = place[at(leaf.node)];
}

void relocate(Grown& grown) {
  for (std::size_t i = grown.size(); i-- > 1;) {
    grown.position[i] = 0.5 * (grown.position[i] + grown.position[at(grown.parent[i])]);
  }
}

void mergeStraight(Grown& grown, double degrees, double longest) {
  const std::vector<std::vector<int>> children = childrenOf(grown);
  const double straight = std::cos(degrees * 3.14159265358979 / 180);
  std::vector<char> keep(grown.size(), 1);
  // Children take over their nearest kept ancestor as they are reached.
  for (std::size_t i = 1; i < grown.size(); ++i) {
    int up = grown.parent[i];
    while (!keep[at(up)]) up = grown.parent[at(up)];
    grown.parent[i] = up;
    if (children[i].size() != 1) continue;
    const dvec3 before = grown.position[i] - grown.position[at(up)];
    const dvec3 after = grown.position[at(children[i][0])] - grown.position[i];
    const double lengths = glm::length(before) * glm::length(after);
    if (glm::length(before + after) < longest && glm::dot(before, after) > straight * lengths) keep[i] = 0;
  }
  keepOnly(grown, keep);
}

void chooseAxes(Grown& grown) {
  std::vector<int> thickest(grown.size(), -1);
  for (std::size_t i = 1; i < grown.size(); ++i) {
    int& best = thickest[at(grown.parent[i])];
    if (best < 0 || grown.radius[i] > grown.radius[at(best)]) best = static_cast<int>(i);
  }
  for (std::size_t i = 1; i < grown.size(); ++i) {
    grown.continues[i] = thickest[at(grown.parent[i])] == static_cast<int>(i);
  }
}

void smooth(Grown& grown, int rounds) {
  std::vector<int> next(grown.size(), -1);
  for (std::size_t i = 1; i < grown.size(); ++i) {
    if (grown.continues[i]) next[at(grown.parent[i])] = static_cast<int>(i);
  }
  for (int round = 0; round < rounds; ++round) {
    const std::vector<dvec3> before = grown.position;
    for (std::size_t i = 1; i < grown.size(); ++i) {
      if (next[i] < 0) continue;
      grown.position[i] = 0.5 * before[i] + 0.25 * (before[at(grown.parent[i])] + before[at(next[i])]);
    }
  }
}

double pipeRadii(Grown& grown, double tip, double taper, double exponent) {
  std::vector<double> sum(grown.size(), 0);
  for (std::size_t i = grown.size(); i-- > 0;) {
    grown.radius[i] = sum[i] > 0 ? std::pow(sum[i], 1 / exponent) : tip;
    if (i == 0) break;
    const double length = glm::length(grown.position[i] - grown.position[at(grown.parent[i])]);
    sum[at(grown.parent[i])] += std::pow(grown.radius[i] + taper * length, exponent);
  }
  return grown.radius[0];
}

void setRadii(Grown& grown, double tip, double base) {
  const double thickest = pipeRadii(grown, tip, 0);
  if (thickest >= base) {
    for (double& radius : grown.radius) radius *= base / thickest;
    return;
  }
  double low = 0, high = 0.05;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (pipeRadii(grown, tip, middle) < base ? low : high) = middle;
  }
  pipeRadii(grown, tip, low);
}

std::vector<double> reachOf(const Grown& grown) {
  std::vector<double> reach(grown.size(), 0);
  for (std::size_t i = grown.size(); i-- > 1;) {
    const std::size_t parent = at(grown.parent[i]);
    reach[parent] = std::max(reach[parent], reach[i] + glm::length(grown.position[i] - grown.position[parent]));
  }
  return reach;
}

std::vector<int> ordersOf(const Grown& grown) {
  std::vector<int> order(grown.size(), 0);
  for (std::size_t i = 1; i < grown.size(); ++i) order[i] = order[at(grown.parent[i])] + (grown.continues[i] ? 0 : 1);
  return order;
}

}  // namespace windfall::model::growth
