// From a skeleton graph to what the rest of the program shows, bends and exports.
#pragma once

#include <QString>

#include "model/plant/geometry.h"
#include "model/plant/rings.h"
#include "model/plant/surface.h"
#include "model/plant/surface_settings.h"
#include "model/progress.h"

namespace windfall::model {

/// What a source holds, before anything was left out.
struct SkeletonCounts {
  int plants = 0, stems = 0, roots = 0, leaves = 0, buds = 0, depth = 0;
  double stemLength = 0;  ///< m, roots not among it
};
SkeletonCounts countsOf(const SkeletonGraph& graph);

/// The skeleton behind a PlantGeometry: segment i of `graph` is bone i. Rings and curves are what meshes are made of,
/// static and adaptive ones.
struct PlantSkeleton {
  SkeletonGraph graph;  ///< without stubs, scaled
  SkeletonCounts counts;
  Chains chains;
  std::vector<ChainCurve> curves;
  RingSet rings;
  SurfaceSettings settings;
};

RingSettings ringSettings(const SurfaceSettings& settings);
MeshSettings meshSettings(const SurfaceSettings& settings);

/// Curves, frames and rings of a graph by the settings and by `rings`. Segments that name no bone become their own.
std::shared_ptr<const PlantSkeleton> makeSkeleton(const SkeletonGraph& graph, const SurfaceSettings& settings,
                                                  const RingSettings& rings);

/// Names for each bone the one that continues its branch.
void continueBones(const PlantSkeleton& skeleton, std::vector<Bone>& bones);

/// Appends the surface to a geometry whose bones the segments name; parts and materials are the caller's.
void addSurface(const PlantSkeleton& skeleton, const MeshSettings& settings, PlantGeometry& geometry);

/// Bones, surface, buds, obstacles, leaf sites and materials of a graph. Errors: nothing to show, cancelled.
Result<PlantGeometry> geometryOf(const SkeletonGraph& graph, const SurfaceSettings& settings, const QString& format,
                                 Progress& progress, WoodMesh wood = WoodMesh::Whole);

/// The skeleton of an imported mesh: its weighted bones as stems.
SkeletonGraph graphOf(const PlantGeometry& geometry);

/// Applies a plant's settings to an imported mesh: scale, chains, and a new surface where that is wanted.
Result<PlantGeometry> withSurface(PlantGeometry geometry, const SurfaceSettings& settings, Progress& progress,
                                  WoodMesh wood = WoodMesh::Whole);

}  // namespace windfall::model
