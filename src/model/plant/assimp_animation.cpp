// Baked clips of a file: its animation channels as rotations of bones against their rest pose (clip.h).
#include <assimp/anim.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "model/plant/assimp_private.h"
#include "model/plant/bake.h"

namespace windfall::model::assimp {

namespace {

constexpr unsigned kMostKeys = 2'000'000;
constexpr double kLongest = 3600, kFinest = 60;   // s, samples a second at most
constexpr std::size_t kMostSamples = 40'000'000;  // of all bones
constexpr double kTolerance = 2e-4;               // rad, about a hundredth of a degree
constexpr float kMoves = 1e-4f;                   // m that a joint may wander and still count as fixed

glm::dquat quaternionOf(const aiQuaternion& q) {
  return {static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z)};
}
glm::dvec3 vectorOf(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// The two keys round a time and the share between them.
template <class Key>
double between(const Key* keys, unsigned count, double time, unsigned& a, unsigned& b) {
  const Key* next = std::upper_bound(keys, keys + count, time, [](double t, const Key& key) { return t < key.mTime; });
  b = std::min(static_cast<unsigned>(next - keys), count - 1);
  a = b > 0 && next != keys + count ? b - 1 : b;
  const double gap = keys[b].mTime - keys[a].mTime;
  return gap > 0 ? std::clamp((time - keys[a].mTime) / gap, 0.0, 1.0) : 0;
}

glm::dvec3 valueAt(const aiVectorKey* keys, unsigned count, double time) {
  unsigned a = 0, b = 0;
  const double share = between(keys, count, time, a, b);
  return glm::mix(vectorOf(keys[a].mValue), vectorOf(keys[b].mValue), share);
}

Transform localAt(const aiNodeAnim& channel, const aiNode& node, double time) {
  aiVector3D scale, place;
  aiQuaternion turn;
  node.mTransformation.Decompose(scale, turn, place);
  glm::dvec3 s = vectorOf(scale), p = vectorOf(place);
  glm::dquat q = quaternionOf(turn);
  if (channel.mNumScalingKeys > 0) s = valueAt(channel.mScalingKeys, channel.mNumScalingKeys, time);
  if (channel.mNumPositionKeys > 0) p = valueAt(channel.mPositionKeys, channel.mNumPositionKeys, time);
  if (channel.mNumRotationKeys > 0) {
    unsigned a = 0, b = 0;
    const double share = between(channel.mRotationKeys, channel.mNumRotationKeys, time, a, b);
    q = glm::slerp(quaternionOf(channel.mRotationKeys[a].mValue), quaternionOf(channel.mRotationKeys[b].mValue), share);
  }
  Transform local(glm::mat3_cast(glm::normalize(q)));
  for (int k = 0; k < 3; ++k) local[k] *= s[k];
  local[3] = glm::dvec4(p, 1);
  return local;
}

/// Rotation part of a transform that may scale.
glm::dquat turnOf(const Transform& transform) {
  glm::dmat3 axes(transform);
  for (int k = 0; k < 3; ++k) {
    const double length = glm::length(axes[k]);
    if (length > 1e-12) axes[k] /= length;
  }
  return glm::normalize(glm::quat_cast(axes));
}

bool isSound(const aiAnimation& animation) {
  unsigned keys = 0;
  for (unsigned c = 0; c < animation.mNumChannels; ++c) {
    const aiNodeAnim& channel = *animation.mChannels[c];
    keys += channel.mNumRotationKeys + channel.mNumPositionKeys + channel.mNumScalingKeys;
    for (unsigned k = 0; k < channel.mNumScalingKeys; ++k) {
      const aiVector3D& v = channel.mScalingKeys[k].mValue;
      if (!std::isfinite(channel.mScalingKeys[k].mTime) || !std::isfinite(v.x + v.y + v.z)) return false;
    }
    for (unsigned k = 0; k < channel.mNumRotationKeys; ++k) {
      const aiQuaternion& q = channel.mRotationKeys[k].mValue;
      const float norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
      if (!std::isfinite(channel.mRotationKeys[k].mTime) || !(norm > 1e-6f && norm < 1e6f)) return false;
    }
    for (unsigned k = 0; k < channel.mNumPositionKeys; ++k) {
      const aiVector3D& v = channel.mPositionKeys[k].mValue;
      if (!std::isfinite(channel.mPositionKeys[k].mTime) || !std::isfinite(v.x + v.y + v.z)) return false;
    }
  }
  return keys > 0 && keys < kMostKeys;
}

/// Time of the first key. What stands before it is no part of the motion: Blender counts frames from 1, and its glTF
/// files begin so much later.
double firstTime(const aiAnimation& animation) {
  double first = animation.mDuration;
  for (unsigned c = 0; c < animation.mNumChannels; ++c) {
    const aiNodeAnim& channel = *animation.mChannels[c];
    if (channel.mNumScalingKeys > 0) first = std::min(first, channel.mScalingKeys[0].mTime);
    if (channel.mNumRotationKeys > 0) first = std::min(first, channel.mRotationKeys[0].mTime);
    if (channel.mNumPositionKeys > 0) first = std::min(first, channel.mPositionKeys[0].mTime);
  }
  return std::max(0.0, first);
}

}  // namespace

void readClips(const File& file, const std::vector<Transform>& binds, PlantGeometry& geometry) {
  const aiScene& scene = *file.scene;
  std::set<QString> names;
  for (unsigned i = 0; i < scene.mNumAnimations; ++i) {
    const aiAnimation& animation = *scene.mAnimations[i];
    QString name = QString::fromUtf8(animation.mName.C_Str()).section('|', -1).simplified();
    if (name.isEmpty()) name = QStringLiteral("Clip %1").arg(i + 1);
    const QString stem = name;
    for (int copy = 2; !names.insert(name).second; ++copy) name = QStringLiteral("%1 %2").arg(stem).arg(copy);
    const double perSecond = animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : file.gltf ? 1000 : 25;
    const bool sound = isSound(animation);
    const double start = sound ? firstTime(animation) : 0, length = (animation.mDuration - start) / perSecond;
    if (!sound || !(length > 0 && length <= kLongest)) {
      geometry.notes << QStringLiteral("its clip \"%1\" cannot be played and was left out").arg(name.left(60));
      continue;
    }
    std::map<std::string, const aiNodeAnim*> channels;
    unsigned densest = 2;
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
      const aiNodeAnim& channel = *animation.mChannels[c];
      channels.emplace(channel.mNodeName.C_Str(), &channel);
      densest = std::max({densest, channel.mNumRotationKeys, channel.mNumPositionKeys});
    }
    const double rate = std::clamp((densest - 1) / length, 1.0, kFinest);
    const auto samples = static_cast<std::size_t>(std::ceil(length * rate - 1e-6));
    const bool moves = std::any_of(file.nodes.begin(), file.nodes.end(),
                                   [&](const Node& node) { return channels.contains(node.source->mName.C_Str()); });
    if (!moves || (samples + 1) * geometry.bones.size() > kMostSamples) {
      geometry.notes << QStringLiteral("its clip \"%1\" moves no bone or is too long").arg(name.left(60));
      continue;
    }

    std::vector<const aiNodeAnim*> ofNode(file.nodes.size(), nullptr);
    for (std::size_t n = 0; n < file.nodes.size(); ++n) {
      const auto found = channels.find(file.nodes[n].source->mName.C_Str());
      if (found != channels.end()) ofNode[n] = found->second;
    }
    Clip clip;
    clip.name = name;
    clip.length = length;
    clip.rate = rate;
    clip.origin = ClipOrigin::Imported;
    clip.tracks.resize(geometry.bones.size());
    std::vector<char> wanders(geometry.bones.size(), 0);
    std::vector<Transform> global(file.nodes.size()), moved(geometry.bones.size());
    std::vector<glm::dquat> turned(geometry.bones.size());
    for (std::size_t sample = 0; sample <= samples; ++sample) {
      const double time = std::min(length, static_cast<double>(sample) / rate);
      for (std::size_t n = 0; n < file.nodes.size(); ++n) {
        const Node& node = file.nodes[n];
        const Transform local = ofNode[n] ? localAt(*ofNode[n], *node.source, start + time * perSecond)
                                          : transformOf(node.source->mTransformation);
        global[n] = node.parent < 0 ? local : global[static_cast<std::size_t>(node.parent)] * local;
        const bool own =
            node.bone >= 0 && (node.parent < 0 || file.nodes[static_cast<std::size_t>(node.parent)].bone != node.bone);
        if (!own) continue;
        const auto b = static_cast<std::size_t>(node.bone);
        // From rest to the pose, in plant space.
        moved[b] = file.toMetres * global[n] * glm::inverse(binds[b]);
        turned[b] = turnOf(moved[b]);
        const int parent = geometry.bones[b].parent;
        const glm::dquat parentTurn = parent < 0 ? glm::dquat(1, 0, 0, 0) : turned[static_cast<std::size_t>(parent)];
        const glm::dvec3 head(geometry.bones[b].head);
        const glm::dvec3 place(moved[b] * glm::dvec4(head, 1));
        glm::dvec3 shift = place - head;
        if (parent >= 0) {
          const auto p = static_cast<std::size_t>(parent);
          const glm::dvec3 parentHead(geometry.bones[p].head);
          const glm::dvec3 carried = glm::dvec3(moved[p] * glm::dvec4(parentHead, 1)) + turned[p] * (head - parentHead);
          shift = glm::conjugate(turned[p]) * (place - carried);
        }
        ClipTrack& track = clip.tracks[b];
        quat q(glm::normalize(glm::conjugate(parentTurn) * turned[b]));
        if (!track.rotations.empty() && glm::dot(q, track.rotations.back()) < 0) q = -q;
        track.times.push_back(static_cast<float>(time));
        track.rotations.push_back(q);
        track.shifts.push_back(vec3(shift));
        if (glm::length(vec3(shift)) > kMoves) wanders[b] = 1;
      }
    }
    double largest = 0;
    std::vector<ClipTrack> kept;
    for (std::size_t b = 0; b < clip.tracks.size(); ++b) {
      ClipTrack& track = clip.tracks[b];
      if (track.times.empty()) continue;
      track.bone = geometry.bones[b].name;
      if (!wanders[b]) {
        track.shifts.clear();
        reduceKeys(track, kTolerance);
      }
      const quat &first = track.rotations.front(), &last = track.rotations.back();
      largest = std::max(largest, 1 - std::abs(static_cast<double>(glm::dot(first, last))));
      kept.push_back(std::move(track));
    }
    clip.tracks = std::move(kept);
    clip.looping = largest < 1e-5;
    geometry.clips.push_back(std::move(clip));
  }
}

}  // namespace windfall::model::assimp
