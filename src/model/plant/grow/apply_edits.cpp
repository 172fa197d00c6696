#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/plant/grow/grow_skeleton.h"

namespace windfall::model::growth {

namespace {

dvec3 toDouble(const QVector3D& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

/// Numbers of nodes made by hand: apart from the growers', and stable while the list of edits is.
int sourceOf(std::size_t edit, std::size_t node) {
  return (1 << 27) + static_cast<int>(edit % 4096) * 8192 + static_cast<int>(node % 8192);
}

std::vector<char> subtree(const Grown& grown, int top) {
  std::vector<char> inside(grown.size(), 0);
  inside[at(top)] = 1;
  for (std::size_t i = at(top) + 1; i < grown.size(); ++i) inside[i] = inside[at(grown.parent[i])];
  return inside;
}

bool subtreeIsAll(const Grown& grown, int top) {
  const std::vector<char> inside = subtree(grown, top);
  return std::count(inside.begin(), inside.end(), 1) + 1 == static_cast<std::ptrdiff_t>(inside.size());
}

void prune(Grown& grown, int node, double stub) {
  const dvec3 from = grown.position[at(grown.parent[at(node)])];
  // Of a felled tree a stump stays.
  if (grown.parent[at(node)] == 0 && subtreeIsAll(grown, node)) stub = std::max(stub, 0.1);
  const std::vector<char> inside = subtree(grown, node);
  std::vector<char> keep(grown.size());
  for (std::size_t i = 0; i < grown.size(); ++i) keep[i] = !inside[i];
  if (stub > 0.02) {
    keep[at(node)] = 1;
    grown.position[at(node)] = from + std::min(stub, 1.0) * (grown.position[at(node)] - from);
    std::erase_if(grown.leaves, [&](const GivenLeaf& leaf) { return leaf.node == node; });
  }
  keepOnly(grown, keep);
}

void bend(Grown& grown, int node, dvec3 axis, double degrees) {
  if (!(glm::length(axis) > 1e-9)) return;
  const double half = 0.5 * degrees * std::numbers::pi / 180;
  const dquat turn(std::cos(half), std::sin(half) * glm::normalize(axis));
  const dvec3 pivot = grown.position[at(grown.parent[at(node)])];
  const std::vector<char> inside = subtree(grown, node);
  for (std::size_t i = 0; i < grown.size(); ++i) {
    if (inside[i]) grown.position[i] = pivot + turn * (grown.position[i] - pivot);
  }
  for (GivenLeaf& leaf : grown.leaves) {
    if (!inside[at(leaf.node)]) continue;
    leaf.position = pivot + turn * (leaf.position - pivot);
    leaf.direction = turn * leaf.direction, leaf.up = turn * leaf.up;
  }
}

void draw(Grown& grown, int node, const HandEdit& edit, std::size_t index) {
  const std::size_t count = edit.line.size();
  const double here = std::max(grown.radius[at(node)], 1e-4);
  const double base = std::min(edit.radius > 0 ? edit.radius : 0.6 * here, here), tip = std::min(base, 0.002);
  int from = node;
  for (std::size_t k = 0; k < count; ++k) {
    const dvec3 place = toDouble(edit.line[k]);
    if (!(glm::length(place - grown.position[at(from)]) > 1e-4)) continue;
    from = grown.add(place, from, grown.birth[at(node)], from != node);
    grown.source[at(from)] = sourceOf(index, k);
    grown.radius[at(from)] = base + (tip - base) * static_cast<double>(k) / static_cast<double>(count);
  }
}

void thicken(Grown& grown, int node, double factor) {
  const std::vector<char> inside = subtree(grown, node);
  for (std::size_t i = 0; i < grown.size(); ++i) {
    if (inside[i]) grown.radius[i] *= factor;
  }
}

/// The node goes by `offset`, what it carries with it; towards the root ever less, over three times its way.
void move(Grown& grown, int node, dvec3 offset) {
  std::vector<double> share(grown.size(), -1);
  const double reach = std::max(3 * glm::length(offset), 0.5);
  double way = 0;
  share[at(node)] = 1;
  for (int i = node; grown.parent[at(i)] >= 0; i = grown.parent[at(i)]) {
    const int up = grown.parent[at(i)];
    way += glm::length(grown.position[at(i)] - grown.position[at(up)]);
    const double t = std::clamp(1 - way / reach, 0.0, 1.0);
    share[at(up)] = grown.parent[at(up)] < 0 ? 0 : t * t * (3 - 2 * t);
  }
  share[0] = 0;
  for (std::size_t i = 1; i < grown.size(); ++i) {
    if (share[i] < 0) share[i] = share[at(grown.parent[i])];
  }
  for (std::size_t i = 0; i < grown.size(); ++i) grown.position[i] += share[i] * offset;
  for (GivenLeaf& leaf : grown.leaves) leaf.position += share[at(leaf.node)] * offset;
}

void graft(Grown& grown, int node, const HandEdit& edit, std::size_t index) {
  dvec3 direction = toDouble(edit.offset);
  if (!(glm::length(direction) > 1e-9)) direction = dvec3(0, 1, 0);
  direction = glm::normalize(direction);
  // The shortest turn from up to the direction, after the roll about up.
  const dvec3 up(0, 1, 0);
  const double along = glm::dot(up, direction);
  const dvec3 across = along < -1 + 1e-9 ? dvec3(1, 0, 0) : glm::cross(up, direction);
  const dquat lean = along < -1 + 1e-9 ? dquat(0, across) : glm::normalize(dquat(1 + along, across));
  const double half = 0.5 * edit.angle * std::numbers::pi / 180;
  const dquat turn = lean * dquat(std::cos(half), 0, std::sin(half), 0);
  std::vector<int> place(edit.part.size(), -1);
  const dvec3 base = grown.position[at(node)];
  for (std::size_t k = 0; k < edit.part.size(); ++k) {
    const PartNode& part = edit.part[k];
    if (part.parent < 0) {
      place[k] = node;
      continue;
    }
    const dvec3 to = base + turn * (edit.factor * toDouble(part.position));
    const int from = place[at(part.parent)];
    place[k] = grown.add(to, from, grown.birth[at(node)], false);
    grown.source[at(place[k])] = sourceOf(index, k);
    grown.radius[at(place[k])] = std::min(part.radius * edit.factor, std::max(grown.radius[at(from)], 1e-4));
  }
}

}  // namespace

void scaleEdit(HandEdit& edit, double scale) {
  const auto s = static_cast<float>(scale);
  edit.place *= s;
  edit.radius *= scale;
  for (QVector3D& point : edit.line) point *= s;
  if (edit.kind == HandEditKind::Move) edit.offset *= s;
  if (edit.kind == HandEditKind::Graft) edit.factor *= scale;
}

int findNode(const Grown& grown, const HandEdit& edit) {
  double height = 0;
  for (const dvec3& place : grown.position) height = std::max(height, place.y);
  const dvec3 wanted = toDouble(edit.place);
  int best = -1;
  double least = 0.06 * height + 0.02;
  for (std::size_t i = 1; i < grown.size(); ++i) {
    const double distance = glm::length(grown.position[i] - wanted);
    if (grown.source[i] == edit.node && distance < 0.12 * height + 0.02) return static_cast<int>(i);
    if (distance < least) least = distance, best = static_cast<int>(i);
  }
  return best;
}

std::vector<int> applyEdits(Grown& grown, const std::vector<HandEdit>& edits, const std::vector<char>& done) {
  std::vector<int> lost;
  for (std::size_t i = 0; i < edits.size(); ++i) {
    if (done[i]) continue;
    const HandEdit& edit = edits[i];
    const int node = findNode(grown, edit);
    if (node <= 0) {
      lost.push_back(static_cast<int>(i));
      continue;
    }
    switch (edit.kind) {
      case HandEditKind::Prune:
        prune(grown, node, edit.stub);
        break;
      case HandEditKind::Bend:
        bend(grown, node, toDouble(edit.axis), edit.angle);
        break;
      case HandEditKind::Draw:
        draw(grown, node, edit, i);
        break;
      case HandEditKind::Thicken:
        thicken(grown, node, edit.factor);
        break;
      case HandEditKind::Move:
        move(grown, node, toDouble(edit.offset));
        break;
      case HandEditKind::Graft:
        graft(grown, node, edit, i);
        break;
    }
  }
  if (edits.empty()) return lost;
  // Nothing may be thicker than what carries it; drawn and grafted parts join the axes.
  for (std::size_t i = grown.size(); i-- > 1;) {
    double& below = grown.radius[at(grown.parent[i])];
    below = std::max(below, grown.radius[i]);
  }
  std::vector<char> onward(grown.size(), 0);
  for (std::size_t i = 1; i < grown.size(); ++i) {
    if (grown.continues[i]) onward[at(grown.parent[i])] = 1;
  }
  for (std::size_t i = 1; i < grown.size(); ++i) {
    const std::size_t parent = at(grown.parent[i]);
    if (!onward[parent]) grown.continues[i] = onward[parent] = 1;
  }
  return lost;
}

}  // namespace windfall::model::growth
