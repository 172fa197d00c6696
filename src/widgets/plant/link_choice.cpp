#include "widgets/plant/link_choice.h"

#include <algorithm>
#include <set>

namespace windfall::widgets {
namespace {

template <class Wanted>
Links where(const sim::Tree& tree, const Wanted& wanted) {
  Links links;
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    if (wanted(i)) links.push_back(i);
  }
  return links;
}

std::vector<char> marked(const sim::Tree& tree, const Links& links) {
  std::vector<char> marks(tree.links.size(), 0);
  for (const std::size_t link : links) {
    if (link < marks.size()) marks[link] = 1;
  }
  return marks;
}

}  // namespace

Links wholeBranches(const sim::Tree& tree, const Links& links) {
  std::set<int> chains;
  for (const std::size_t link : links) chains.insert(tree.links[link].chain);
  return where(tree, [&](std::size_t i) { return chains.contains(tree.links[i].chain); });
}

Links withChildren(const sim::Tree& tree, const Links& links) {
  std::vector<char> marks = marked(tree, links);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const int parent = tree.links[i].parent;
    if (parent >= 0 && marks[static_cast<std::size_t>(parent)]) marks[i] = 1;
  }
  return where(tree, [&](std::size_t i) { return marks[i] != 0; });
}

Links carriers(const sim::Tree& tree, const Links& links) {
  const std::vector<char> own = marked(tree, links);
  std::vector<char> marks = own;
  for (std::size_t i = marks.size(); i-- > 0;) {
    const int parent = tree.links[i].parent;
    if (marks[i] && parent >= 0) marks[static_cast<std::size_t>(parent)] = 1;
  }
  return where(tree, [&](std::size_t i) { return marks[i] && !own[i]; });
}

Links ofOrder(const sim::Tree& tree, int low, int high) {
  return where(tree, [&](std::size_t i) { return tree.links[i].order >= low && tree.links[i].order <= high; });
}

Links sameOrder(const sim::Tree& tree, const Links& links) {
  std::set<int> orders;
  for (const std::size_t link : links) orders.insert(tree.links[link].order);
  return where(tree, [&](std::size_t i) { return orders.contains(tree.links[i].order); });
}

Links insideBox(const QRectF& box, const std::vector<LinkCapsule>& capsules, const std::vector<mat4>& pose,
                const OrbitCamera& camera, QSize size) {
  Links links;
  for (std::size_t i = 0; i < std::min(capsules.size(), pose.size()); ++i) {
    const vec3 middle(pose[i] * vec4((capsules[i].from + capsules[i].to) / 2.f, 1));
    const auto place = camera.project(middle, size);
    if (place && box.contains(*place)) links.push_back(i);
  }
  return links;
}

double branchFrequency(const sim::Tree& tree, std::size_t link) {
  if (link >= tree.links.size()) return 0;
  std::size_t first = link;
  // The base of its branch.
  while (tree.links[first].parent >= 0 &&
         tree.links[static_cast<std::size_t>(tree.links[first].parent)].chain == tree.links[link].chain) {
    first = static_cast<std::size_t>(tree.links[first].parent);
  }
  sim::Tree part;
  for (const std::size_t i : withChildren(tree, {first})) {
    sim::Link copy = tree.links[i];
    // Subtrees are contiguous.
    copy.parent = i == first ? -1 : copy.parent - static_cast<int>(first);
    part.links.push_back(copy);
  }
  return sim::firstFrequency(part);
}

}  // namespace windfall::widgets
