#include "model/plant/clip.h"

#include <QDataStream>
#include <QHash>
#include <QIODevice>
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "model/plant/geometry.h"

namespace windfall::model {

namespace {

constexpr quint32 kMagic = 0x57464b31;  // "WFK1"
constexpr quint32 kMostTracks = 4'000'000, kMostKeys = 10'000'000;

bool isSound(const ClipTrack& track) {
  if (track.times.empty() || track.times.size() != track.rotations.size()) return false;
  if (!track.shifts.empty() && track.shifts.size() != track.times.size()) return false;
  for (std::size_t i = 0; i < track.times.size(); ++i) {
    if (!std::isfinite(track.times[i]) || (i > 0 && track.times[i] < track.times[i - 1])) return false;
    const float norm = glm::dot(track.rotations[i], track.rotations[i]);
    if (!(norm > 0.98f && norm < 1.02f)) return false;
  }
  return std::all_of(track.shifts.begin(), track.shifts.end(), [](const vec3& v) { return glm::dot(v, v) < 1e10f; });
}

/// Matrix of a bone that turns by `pose` about its head on its parent.
mat4 onParent(const mat4& parent, const vec3& head, const TrackPose& pose) {
  mat4 local = glm::mat4_cast(pose.rotation);
  local[3] = vec4(head + pose.shift - glm::mat3_cast(pose.rotation) * head, 1);
  return parent * local;
}

}  // namespace

std::size_t Clip::keyCount() const {
  std::size_t count = 0;
  for (const ClipTrack& track : tracks) count += track.times.size();
  return count;
}

TrackPose poseAt(const ClipTrack& track, float time) {
  TrackPose pose;
  if (track.times.empty()) return pose;
  const auto next = std::upper_bound(track.times.begin(), track.times.end(), time);
  const auto b = std::min<std::size_t>(static_cast<std::size_t>(next - track.times.begin()), track.times.size() - 1);
  const std::size_t a = b > 0 && next != track.times.end() ? b - 1 : b;
  const float gap = track.times[b] - track.times[a];
  const float share = gap > 0 ? std::clamp((time - track.times[a]) / gap, 0.0f, 1.0f) : 0;
  pose.rotation = glm::slerp(track.rotations[a], track.rotations[b], share);
  if (!track.shifts.empty()) pose.shift = glm::mix(track.shifts[a], track.shifts[b], share);
  return pose;
}

std::vector<mat4> poseAt(const Clip& clip, const std::vector<Bone>& bones, double time) {
  if (clip.looping && clip.length > 0) time -= std::floor(time / clip.length) * clip.length;
  QHash<QString, const ClipTrack*> byName;
  for (const ClipTrack& track : clip.tracks) byName.insert(track.bone, &track);
  std::vector<mat4> pose;
  pose.reserve(bones.size());
  for (const Bone& bone : bones) {
    const mat4 parent = bone.parent < 0 ? mat4(1) : pose[static_cast<std::size_t>(bone.parent)];
    const ClipTrack* track = byName.value(bone.name);
    pose.push_back(track ? onParent(parent, bone.head, poseAt(*track, static_cast<float>(time))) : parent);
  }
  return pose;
}

QByteArray packTracks(const std::vector<ClipTrack>& tracks) {
  QByteArray bytes;
  QDataStream stream(&bytes, QIODevice::WriteOnly);
  stream.setVersion(QDataStream::Qt_6_4);
  stream.setByteOrder(QDataStream::LittleEndian);
  stream.setFloatingPointPrecision(QDataStream::SinglePrecision);
  stream << kMagic << static_cast<quint32>(tracks.size());
  for (const ClipTrack& track : tracks) {
    stream << track.bone.toUtf8() << static_cast<quint32>(track.times.size()) << !track.shifts.empty();
    for (const float time : track.times) stream << time;
    for (const quat& q : track.rotations) stream << q.x << q.y << q.z << q.w;
    for (const vec3& v : track.shifts) stream << v.x << v.y << v.z;
  }
  return bytes;
}

bool unpackTracks(const QByteArray& bytes, std::vector<ClipTrack>& tracks) {
  QDataStream stream(bytes);
  stream.setVersion(QDataStream::Qt_6_4);
  stream.setByteOrder(QDataStream::LittleEndian);
  stream.setFloatingPointPrecision(QDataStream::SinglePrecision);
  quint32 magic = 0, count = 0;
  stream >> magic >> count;
  if (magic != kMagic || count > kMostTracks) return false;
  std::vector<ClipTrack> read;
  for (quint32 i = 0; i < count; ++i) {
    ClipTrack track;
    QByteArray name;
    quint32 keys = 0;
    bool shifted = false;
    stream >> name >> keys >> shifted;
    // 20 bytes a key at least: a lying count must not take memory.
    if (stream.status() != QDataStream::Ok || keys > kMostKeys || qint64{20} * keys > bytes.size()) return false;
    track.bone = QString::fromUtf8(name);
    track.times.resize(keys);
    track.rotations.resize(keys);
    if (shifted) track.shifts.resize(keys);
    for (float& time : track.times) stream >> time;
    for (quat& q : track.rotations) stream >> q.x >> q.y >> q.z >> q.w;
    for (vec3& v : track.shifts) stream >> v.x >> v.y >> v.z;
    if (stream.status() != QDataStream::Ok || !isSound(track)) return false;
    read.push_back(std::move(track));
  }
  if (!stream.atEnd()) return false;
  tracks = std::move(read);
  return true;
}

}  // namespace windfall::model
