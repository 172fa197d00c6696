// Loopable wind clips from the simulation (issue 3; artists.md, "wind that an engine can play").
#pragma once

#include "model/plant/bodies.h"
#include "model/plant/clip.h"
#include "model/progress.h"
#include "sim/result.h"
#include "sim/settings.h"

namespace windfall::model {

struct BakeSettings {
  QString name;
  double length = 6;        ///< s
  double rate = 30;         ///< samples a second
  double warmUp = 8;        ///< s simulated before, so that the tree is in motion
  double tolerance = 0.15;  ///< degrees that a bone may differ from the simulation after keys were left out
  bool looping = true;
  sim::WindSettings wind;
  sim::SolverSettings solver;
};

/// Simulates a plant alone and keeps the rotations of its bones. A looping clip ends as it began: its first seconds are
/// blended, bone by bone on the sphere of rotations, out of what follows its end. Keys that slerp between their
/// neighbours gives within the tolerance are left out. Deterministic. Errors for settings that make no clip.
Result<Clip> bakeClip(const PlantGeometry& geometry, const PlantBodies& bodies, const BakeSettings& settings,
                      Progress& progress);

/// Leaves out keys of a track: every sample lies within `tolerance` radians of what is kept, the first and the last
/// stay.
void reduceKeys(ClipTrack& track, double tolerance);

}  // namespace windfall::model
