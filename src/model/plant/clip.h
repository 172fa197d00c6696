// A recorded motion of a plant: baked from the simulation, or found in its file.
#pragma once

#include <QByteArray>
#include <QString>
#include <vector>

#include "kernels/math.h"

namespace windfall::model {

struct Bone;

/// The motion of one bone. Everything is relative to the rest pose and to the parent bone, in the axes of plant space,
/// so it does not depend on how a format orients its bones: with R_b the rotation that takes bone b from rest to its
/// pose (plant space, identity at rest), R_b = R_parent * rotation_b, and its head lies where the parent's motion
/// carries `head + shift`. A format whose joint has the rest rotation Q (to plant space), of parent Q_p, writes the
/// local rotation conj(Q_p) * rotation * Q. Between keys: slerp, and linear shifts.
struct ClipTrack {
  QString bone;                 ///< name, as in PlantGeometry::bones; a bone without a track rests against its parent
  std::vector<float> times;     ///< s, ascending, first 0; a looping clip's last key stands at its length
  std::vector<quat> rotations;  ///< a unit quaternion a time; of the looping ones the last equals the first
  std::vector<vec3> shifts;     ///< m, a value a time; empty: the bone stays at its joint
  bool operator==(const ClipTrack&) const = default;
};

enum class ClipOrigin { Baked, Imported };

struct Clip {
  QString name;          ///< unique among a plant's clips
  double length = 0;     ///< s
  double rate = 30;      ///< samples a second that it was made with
  bool looping = false;  ///< the last pose equals the first
  ClipOrigin origin = ClipOrigin::Baked;
  std::vector<ClipTrack> tracks;
  bool operator==(const Clip&) const = default;

  std::size_t keyCount() const;
};

/// Rotation and shift of a track at a time; a time outside is the nearest key.
struct TrackPose {
  quat rotation{1, 0, 0, 0};
  vec3 shift{0};
};
TrackPose poseAt(const ClipTrack& track, float time);

/// Every bone's matrix, plant space at rest to plant space posed, at `time` s (looping clips wrap it). `bones` with
/// parents before children.
std::vector<mat4> poseAt(const Clip& clip, const std::vector<Bone>& bones, double time);

/// Tracks as bytes for the project file, little-endian, and back; false for bytes that are no tracks.
QByteArray packTracks(const std::vector<ClipTrack>& tracks);
bool unpackTracks(const QByteArray& bytes, std::vector<ClipTrack>& tracks);

}  // namespace windfall::model
