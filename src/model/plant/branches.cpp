#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "model/plant/links_private.h"

namespace windfall::model {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

float lengthOf(const Bone& bone) { return glm::length(bone.tail - bone.head); }

/// "limb.12" for the bone "limb.12.000".
QString branchName(const QString& bone) {
  qsizetype end = bone.size();
  while (end > 0 && bone[end - 1].isDigit()) --end;
  return end > 1 && end < bone.size() && (bone[end - 1] == '.' || bone[end - 1] == '_') ? bone.left(end - 1) : bone;
}

}  // namespace

bool bends(const Bone& bone) { return lengthOf(bone) >= std::max(1e-4f, 0.1f * bone.radius); }

LinkForest linkForest(const std::vector<Bone>& bones) {
  const std::size_t count = bones.size();
  LinkForest forest;
  forest.link.assign(count, 0);
  forest.parent.assign(count, -1);
  forest.children.resize(count);
  forest.next.assign(count, -1);
  for (std::size_t b = 0; b < count; ++b) {
    const Bone& bone = bones[b];
    forest.link[b] = bone.weighted && bends(bone);
    // Parents stand first, so what lies above a parent that is no link is known.
    const bool direct = bone.parent < 0 || forest.link[at(bone.parent)];
    const int parent = direct ? bone.parent : forest.parent[at(bone.parent)];
    forest.parent[b] = parent;
    if (forest.link[b] && parent >= 0) forest.children[at(parent)].push_back(static_cast<int>(b));
  }
  std::vector<float> reach(count, 0);
  std::vector<int> onward(count, -1);  // the first link from a bone on, along its branch
  for (std::size_t b = count; b-- > 0;) {
    const int next = bones[b].next;
    onward[b] = forest.link[b] ? static_cast<int>(b) : next > static_cast<int>(b) ? onward[at(next)] : -1;
    if (!forest.link[b]) continue;
    for (const int child : forest.children[b]) reach[b] = std::max(reach[b], reach[at(child)]);
    reach[b] += lengthOf(bones[b]);
  }
  for (std::size_t b = 0; b < count; ++b) {
    const Bone& bone = bones[b];
    // A total order, so that the order of siblings in the file does not matter.
    const auto rank = [&](int index) {
      const Bone& child = bones[at(index)];
      const float lengths = std::max(lengthOf(child) * lengthOf(bone), 1e-12f);
      const float straight = glm::dot(child.tail - child.head, bone.tail - bone.head) / lengths;
      return std::make_tuple(reach[at(index)], child.radius, straight, -child.tail.x, -child.tail.y, -child.tail.z);
    };
    if (bone.next != Bone::kByLength) {
      const int next = bone.next < 0 ? -1 : onward[at(bone.next)];
      if (next >= 0 && forest.parent[at(next)] == static_cast<int>(b)) forest.next[b] = next;
      continue;
    }
    for (const int child : forest.children[b]) {
      if (glm::length(bones[at(child)].head - bone.tail) > 2 * bone.radius + 1e-5f) continue;
      if (forest.next[b] < 0 || rank(forest.next[b]) < rank(child)) forest.next[b] = child;
    }
  }
  return forest;
}

std::vector<Branch> findBranches(const std::vector<Bone>& bones) {
  const LinkForest forest = linkForest(bones);
  std::vector<Branch> branches;
  std::vector<int> branchOf(bones.size(), -1);
  std::set<QString> names;
  // Breadth first: limbs before twigs.
  std::vector<int> starts;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    if (forest.link[b] && forest.parent[b] < 0) starts.push_back(static_cast<int>(b));
  }
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const int start = starts[i], parent = forest.parent[at(start)];
    Branch branch;
    branch.parent = parent < 0 ? -1 : branchOf[at(parent)];
    branch.order = branch.parent < 0 ? 0 : branches[at(branch.parent)].order + 1;
    branch.baseRadius = static_cast<double>(bones[at(start)].radius);
    branch.name = branchName(bones[at(start)].name);
    if (!names.insert(branch.name).second) {
      branch.name = bones[at(start)].name;
      names.insert(branch.name);
    }
    for (int b = start; b >= 0; b = forest.next[at(b)]) {
      branch.bones.push_back(b);
      branch.length += static_cast<double>(lengthOf(bones[at(b)]));
      branchOf[at(b)] = static_cast<int>(branches.size());
      for (const int child : forest.children[at(b)]) {
        if (child != forest.next[at(b)]) starts.push_back(child);
      }
    }
    branches.push_back(std::move(branch));
  }
  return branches;
}

std::vector<char> terminalBranches(const std::vector<Branch>& branches) {
  std::vector<char> terminal(branches.size(), 1);
  for (const Branch& branch : branches) {
    if (branch.parent >= 0) terminal[at(branch.parent)] = 0;
  }
  return terminal;
}

double naturalLeafArea(const std::vector<Bone>& bones, const std::vector<Branch>& branches) {
  constexpr double kPi = 3.14159265358979;
  double squares = 0, crown = 0, height = 0;
  vec3 base(0);
  for (const Branch& branch : branches) {
    if (branch.parent >= 0) continue;
    squares += branch.baseRadius * branch.baseRadius;
    base = bones[at(branch.bones.front())].head;
  }
  for (const Branch& branch : branches) {
    for (const int b : branch.bones) {
      const vec3 d = bones[at(b)].tail - base;
      crown = std::max(crown, static_cast<double>(std::hypot(d.x, d.z)));
      height = std::max(height, static_cast<double>(d.y));
    }
  }
  crown = std::max(crown, 0.1 * height);
  return std::min(2000 * kPi * squares, 6 * kPi * crown * crown);
}

}  // namespace windfall::model
