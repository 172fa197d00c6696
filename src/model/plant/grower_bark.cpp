#include "model/plant/grower_private.h"
#include "model/plant/skeleton_geometry.h"

namespace windfall::model::grower {

namespace {

/// The picture of barkTexture: as tall as twice its width.
constexpr float kTileWidth = 0.45f, kTileAspect = 2;

SkeletonGraph graphOf(const std::vector<Axis>& axes) {
  SkeletonGraph graph;
  std::vector<std::size_t> first;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const Axis& axis = axes[a];
    first.push_back(graph.segments.size());
    for (std::size_t i = 0; i + 1 < axis.nodes.size(); ++i) {
      Segment s;
      s.a = axis.nodes[i], s.b = axis.nodes[i + 1];
      s.ra = axis.radii[i], s.rb = axis.radii[i + 1];
      s.parent = static_cast<std::int32_t>(graph.segments.size()) - 1;
      if (i == 0) {
        s.parent = axis.parent < 0
                       ? -1
                       : static_cast<std::int32_t>(first[static_cast<std::size_t>(axis.parent)]) + axis.parentLink;
        s.attach = axis.parent < 0 ? 1 : axis.parentShare;
      }
      s.bone = axis.firstBone + static_cast<std::int32_t>(i);
      s.branch = static_cast<std::int32_t>(a);
      graph.segments.push_back(s);
    }
  }
  return graph;
}

}  // namespace

void buildBark(const std::vector<Axis>& axes, PlantGeometry& geometry, const SurfaceSettings& surface, float barkFrom) {
  RingSettings rings = ringSettings(surface);
  rings.textureAspect = kTileAspect;
  MeshSettings mesh = meshSettings(surface);
  mesh.tile = kTileWidth * mesh.tile / static_cast<float>(SurfaceSettings().tile);
  mesh.barkFrom = barkFrom;
  // The adaptive mesh takes its tile from here.
  SurfaceSettings own = surface;
  own.tile = static_cast<double>(mesh.tile);
  const std::shared_ptr<const PlantSkeleton> skeleton = makeSkeleton(graphOf(axes), own, rings);
  if (geometry.wood == WoodMesh::Whole) addSurface(*skeleton, mesh, geometry);
  continueBones(*skeleton, geometry.bones);
  geometry.skeleton = skeleton;
}

}  // namespace windfall::model::grower
