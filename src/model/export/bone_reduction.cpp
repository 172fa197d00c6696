#include "model/export/bone_reduction.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "model/plant/bodies.h"
#include "model/plant/frames.h"

namespace windfall::model {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Bones of a branch that start a merged bone, at a tolerance in m.
std::vector<char> startsOf(const std::vector<int>& branch, const std::vector<Bone>& bones, float tolerance) {
  std::vector<vec3> joints;
  for (const int b : branch) joints.push_back(bones[at(b)].head);
  joints.push_back(bones[at(branch.back())].tail);
  std::vector<char> keep(joints.size(), 0);
  keep.front() = keep.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, joints.size() - 1}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    float worst = tolerance;
    std::size_t split = 0;
    for (std::size_t i = a + 1; i < b; ++i) {
      const float share = closestShare(joints[a], joints[b], joints[i]);
      const float off = glm::length(joints[a] + (joints[b] - joints[a]) * share - joints[i]);
      if (off > worst) worst = off, split = i;
    }
    if (split == 0) continue;
    keep[split] = 1;
    open.emplace_back(a, split);
    open.emplace_back(split, b);
  }
  keep.pop_back();
  return keep;
}

/// Which bone stands for which: the first of its merged run.
struct Merge {
  std::vector<int> of;
  int count = 0, depth = 0;
};

Merge mergeAt(const std::vector<Branch>& branches, const std::vector<Bone>& bones, float tolerance) {
  Merge merge;
  merge.of.assign(bones.size(), -1);
  for (const Branch& branch : branches) {
    const std::vector<char> starts = startsOf(branch.bones, bones, tolerance);
    int run = -1;
    for (std::size_t i = 0; i < branch.bones.size(); ++i) {
      if (starts[i]) run = branch.bones[i], ++merge.count;
      merge.of[at(branch.bones[i])] = run;
    }
  }
  // What became no link goes with its parent; below a root that did not, with nothing.
  for (std::size_t b = 0; b < bones.size(); ++b) {
    if (merge.of[b] < 0 && bones[b].parent >= 0) merge.of[b] = merge.of[at(bones[b].parent)];
  }
  std::vector<int> depth(bones.size(), 0);
  for (std::size_t b = 0; b < bones.size(); ++b) {
    const int own = merge.of[b];
    if (own != static_cast<int>(b)) continue;
    const int above = bones[b].parent < 0 ? -1 : merge.of[at(bones[b].parent)];
    depth[b] = above < 0 ? 1 : depth[at(above)] + 1;
    merge.depth = std::max(merge.depth, depth[b]);
  }
  return merge;
}

/// Folds the branches of least wood into what carries them, until few enough are left.
void fold(std::vector<Branch> branches, const std::vector<Bone>& bones, int limit, Merge& merge) {
  std::vector<double> subtree;
  std::vector<int> children(branches.size(), 0), size(branches.size(), 0);
  for (std::size_t i = 0; i < branches.size(); ++i) {
    subtree.push_back(branches[i].length);
    for (const int b : branches[i].bones) size[i] += merge.of[at(b)] == b;
    if (branches[i].parent >= 0) ++children[at(branches[i].parent)];
  }
  for (std::size_t i = branches.size(); i-- > 0;) {
    if (branches[i].parent >= 0) subtree[at(branches[i].parent)] += subtree[i];
  }
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> leaves;
  for (std::size_t i = 0; i < branches.size(); ++i) {
    if (children[i] == 0 && branches[i].parent >= 0) leaves.emplace(subtree[i], static_cast<int>(i));
  }
  while (merge.count > limit && !leaves.empty()) {
    const auto branch = at(leaves.top().second);
    leaves.pop();
    const int carrier = bones[at(branches[branch].bones.front())].parent;
    for (const int b : branches[branch].bones) merge.of[at(b)] = carrier;
    merge.count -= size[branch];
    const int parent = branches[branch].parent;
    if (--children[at(parent)] == 0 && branches[at(parent)].parent >= 0) leaves.emplace(subtree[at(parent)], parent);
  }
  // Parents stand before children, so one pass finds who is left.
  for (std::size_t b = 0; b < bones.size(); ++b) {
    int& own = merge.of[b];
    if (own >= 0 && own != static_cast<int>(b)) own = merge.of[at(own)];
  }
}

void limitDepth(const std::vector<Bone>& bones, int limit, Merge& merge) {
  std::vector<int> depth(bones.size(), 0);
  for (std::size_t b = 0; b < bones.size(); ++b) {
    if (merge.of[b] != static_cast<int>(b)) {
      if (merge.of[b] >= 0) merge.of[b] = merge.of[at(merge.of[b])];
      continue;
    }
    const int above = bones[b].parent < 0 ? -1 : merge.of[at(bones[b].parent)];
    depth[b] = above < 0 ? 1 : depth[at(above)] + 1;
    if (depth[b] > limit) merge.of[b] = above;
  }
}

/// Where a merged bone's clip turns it: by the way its ends move.
Clip resampled(const Clip& clip, const std::vector<Bone>& before, const std::vector<Bone>& after,
               const std::vector<int>& firstOf, const std::vector<int>& lastOf) {
  Clip result = clip;
  result.tracks.clear();
  for (const Bone& bone : after) {
    ClipTrack track;
    track.bone = bone.name;
    result.tracks.push_back(track);
  }
  const int samples = std::max(1, static_cast<int>(std::lround(clip.length * clip.rate)));
  std::vector<quat> global(after.size());
  for (int k = 0; k <= samples; ++k) {
    const double time = k == samples ? clip.length : clip.length * k / samples;
    const std::vector<mat4> pose = poseAt(clip, before, k == samples && clip.looping ? 0 : time);
    for (std::size_t b = 0; b < after.size(); ++b) {
      const mat4 &foot = pose[at(firstOf[b])], &top = pose[at(lastOf[b])];
      const vec3 was = after[b].tail - after[b].head;
      const vec3 now = vec3(top * vec4(after[b].tail, 1)) - vec3(foot * vec4(after[b].head, 1));
      // The first bone's own turn, then the rest of the way to where the end has gone.
      const quat own = glm::normalize(glm::quat_cast(mat3(foot)));
      const vec3 turned = own * was, cross = glm::cross(turned, now);
      const float sine = glm::length(cross), cosine = glm::dot(turned, now);
      quat rest(1, 0, 0, 0);
      if (sine > 1e-9f) rest = glm::angleAxis(std::atan2(sine, cosine), cross / sine);
      global[b] = glm::normalize(rest * own);
      const int parent = after[b].parent;
      quat local = parent < 0 ? global[b] : glm::normalize(glm::conjugate(global[at(parent)]) * global[b]);
      ClipTrack& track = result.tracks[b];
      if (!track.rotations.empty() && glm::dot(track.rotations.back(), local) < 0) local = -local;
      track.times.push_back(static_cast<float>(time));
      track.rotations.push_back(local);
    }
  }
  return result;
}

}  // namespace

void reduceBones(PlantGeometry& geometry, std::vector<Clip>& clips, const BoneLimits& limits) {
  const std::vector<Bone> before = geometry.bones;
  const std::vector<Branch> branches = findBranches(before);
  if (branches.empty()) return;
  const auto fits = [&](const Merge& merge) {
    return (limits.count <= 0 || merge.count <= limits.count) && (limits.depth <= 0 || merge.depth <= limits.depth);
  };
  Merge merge = mergeAt(branches, before, -1);
  const bool merges = !fits(merge);
  for (float tolerance = 1e-3f; !fits(merge) && tolerance < 1.0f; tolerance *= 1.6f) {
    merge = mergeAt(branches, before, tolerance);
  }
  if (limits.count > 0 && merge.count > limits.count) fold(branches, before, std::max(limits.count, 1), merge);
  if (limits.depth > 0) limitDepth(before, limits.depth, merge);

  std::vector<Bone> after;
  std::vector<int> place(before.size(), -1), firstOf, lastOf;
  for (std::size_t b = 0; b < before.size(); ++b) {
    if (merge.of[b] != static_cast<int>(b)) continue;
    Bone bone = before[b];
    bone.parent = bone.parent < 0 || merge.of[at(bone.parent)] < 0 ? -1 : place[at(merge.of[at(bone.parent)])];
    bone.next = Bone::kByLength;
    place[b] = static_cast<int>(after.size());
    firstOf.push_back(static_cast<int>(b));
    lastOf.push_back(static_cast<int>(b));
    after.push_back(bone);
  }
  std::vector<int> branchOf(before.size(), -1);
  for (std::size_t i = 0; i < branches.size(); ++i) {
    for (const int b : branches[i].bones) branchOf[at(b)] = static_cast<int>(i);
  }
  for (const Branch& branch : branches) {
    for (const int b : branch.bones) {
      const int own = merge.of[at(b)];
      if (own < 0 || branchOf[at(own)] != branchOf[at(b)]) continue;
      after[at(place[at(own)])].tail = before[at(b)].tail;
      lastOf[at(place[at(own)])] = b;
    }
  }
  const auto bone = [&](std::size_t b) { return merge.of[b] < 0 ? 0 : std::max(place[at(merge.of[b])], 0); };
  for (Vertex& vertex : geometry.vertices) {
    const auto from = vertex.bones;
    const auto weights = vertex.weights;
    vertex.bones = {}, vertex.weights = {};
    std::size_t used = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (weights[i] <= 0) continue;
      const auto to = static_cast<std::uint32_t>(bone(from[i]));
      std::size_t k = 0;
      while (k < used && vertex.bones[k] != to) ++k;
      if (k == used) vertex.bones[used++] = to;
      vertex.weights[k] += weights[i];
    }
  }
  for (sim::LeafSite& site : geometry.leafSites) {
    const Bone &was = before[at(site.link)], &now = after[at(bone(at(site.link)))];
    const quat there = alongZ(was.tail - was.head), back = glm::conjugate(alongZ(now.tail - now.head));
    site.position = back * (was.head + there * site.position - now.head);
    site.rotation = glm::normalize(back * there * site.rotation);
    site.link = bone(at(site.link));
  }
  if (merges || after.size() != before.size()) {
    for (Clip& clip : clips) clip = resampled(clip, before, after, firstOf, lastOf);
  }
  geometry.bones = std::move(after);
  geometry.skeleton = nullptr;
}

}  // namespace windfall::model
