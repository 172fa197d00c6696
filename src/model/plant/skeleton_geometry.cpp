#include "model/plant/skeleton_geometry.h"

#include <algorithm>
#include <cmath>

#include "model/plant/bark.h"
#include "model/plant/frames.h"
#include "model/plant/skeleton_organs.h"

namespace windfall::model {

namespace {

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

/// "stem.12", in files of many plants "plant3.stem.12"; stable as long as the file is.
QString boneName(const Segment& s, std::size_t index, int plants) {
  const QString kind = s.kind == SegmentKind::Root      ? QStringLiteral("root")
                       : s.kind == SegmentKind::Petiole ? QStringLiteral("petiole")
                                                        : QStringLiteral("stem");
  const QString own = QStringLiteral("%1.%2").arg(kind).arg(s.organ >= 0 ? static_cast<std::size_t>(s.organ) : index);
  return plants > 1 ? QStringLiteral("plant%1.%2").arg(s.plant + 1).arg(own) : own;
}

void addBones(const PlantSkeleton& skeleton, PlantGeometry& geometry) {
  const SkeletonGraph& graph = skeleton.graph;
  for (std::size_t i = 0; i < graph.segments.size(); ++i) {
    const Segment& s = graph.segments[i];
    Bone bone;
    bone.name = boneName(s, i, graph.plants);
    bone.parent = s.parent;
    bone.head = s.a, bone.tail = s.b;
    bone.radius = std::max(0.5f * (s.ra + s.rb), 1e-5f);
    // Roots stand still in the ground.
    bone.weighted = s.kind != SegmentKind::Root;
    geometry.bones.push_back(bone);
  }
  continueBones(skeleton, geometry.bones);
}

}  // namespace

SkeletonCounts countsOf(const SkeletonGraph& graph) {
  SkeletonCounts counts;
  counts.plants = graph.plants;
  counts.leaves = static_cast<int>(graph.leaves.size());
  counts.buds = static_cast<int>(graph.buds.size());
  std::vector<int> depth(graph.segments.size(), 1);
  for (std::size_t i = 0; i < graph.segments.size(); ++i) {
    const Segment& s = graph.segments[i];
    if (s.parent >= 0) depth[i] = depth[at(s.parent)] + 1;
    if (s.kind == SegmentKind::Root) {
      ++counts.roots;
      continue;
    }
    ++counts.stems;
    counts.stemLength += static_cast<double>(lengthOf(s));
    counts.depth = std::max(counts.depth, depth[i]);
  }
  const auto hanging = [&](std::int32_t segment) {
    counts.depth = std::max(counts.depth, segment < 0 ? 1 : depth[at(segment)] + 1);
  };
  for (const LeafOrgan& leaf : graph.leaves) hanging(leaf.segment);
  for (const BudOrgan& bud : graph.buds) hanging(bud.segment);
  return counts;
}

void continueBones(const PlantSkeleton& skeleton, std::vector<Bone>& bones) {
  const Chains& chains = skeleton.chains;
  const auto boneOf = [&](std::uint32_t link) { return skeleton.graph.segments[chains.links[link]].bone; };
  for (Bone& bone : bones) bone.next = -1;
  for (const Chain& chain : chains.chains) {
    for (std::uint32_t i = chain.first; i + 1 < chain.first + chain.count; ++i) {
      bones[at(boneOf(i))].next = boneOf(i + 1);
    }
  }
}

RingSettings ringSettings(const SurfaceSettings& settings) {
  RingSettings rings;
  rings.flare = static_cast<float>(settings.flare);
  return rings;
}

MeshSettings meshSettings(const SurfaceSettings& settings) {
  MeshSettings mesh;
  mesh.tolerance = toleranceOf(settings.detail);
  mesh.lobes = static_cast<float>(settings.lobes);
  mesh.gnarl = static_cast<float>(settings.gnarl);
  mesh.tile = static_cast<float>(settings.tile);
  mesh.bakeRepeats = settings.bakeRepeats;
  return mesh;
}

std::shared_ptr<const PlantSkeleton> makeSkeleton(const SkeletonGraph& graph, const SurfaceSettings& settings,
                                                  const RingSettings& rings) {
  auto skeleton = std::make_shared<PlantSkeleton>();
  skeleton->settings = settings;
  skeleton->counts = countsOf(graph);
  skeleton->counts.stemLength *= settings.scale;
  skeleton->graph = withoutStubs(settings.scale == 1 ? graph : scaled(graph, settings.scale));
  std::vector<Segment>& segments = skeleton->graph.segments;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i].bone < 0) segments[i].bone = static_cast<std::int32_t>(i);
    if (!settings.followsState) segments[i].state.wood = -1;
  }
  skeleton->chains = findChains(skeleton->graph, settings.chains);
  skeleton->curves = makeCurves(skeleton->graph, skeleton->chains, settings.curve);
  skeleton->rings = makeRings(skeleton->graph, skeleton->chains, skeleton->curves, rings);
  return skeleton;
}

void addSurface(const PlantSkeleton& skeleton, const MeshSettings& settings, PlantGeometry& geometry) {
  SurfaceMesh mesh = meshRings(skeleton.graph, skeleton.chains, skeleton.curves, skeleton.rings, settings);
  const auto first = static_cast<std::uint32_t>(geometry.vertices.size());
  const auto& segments = skeleton.graph.segments;
  for (Vertex& vertex : mesh.vertices) {
    for (std::uint32_t& bone : vertex.bones) bone = static_cast<std::uint32_t>(segments[bone].bone);
  }
  if (first == 0) {
    geometry.vertices = std::move(mesh.vertices);
  } else {
    geometry.vertices.insert(geometry.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  }
  geometry.indices.reserve(geometry.indices.size() + mesh.indices.size());
  for (std::size_t c = 0; c < skeleton.chains.chains.size(); ++c) {
    const std::uint32_t start = skeleton.chains.links[skeleton.chains.chains[c].first];
    if (segments[start].kind == SegmentKind::Root && !skeleton.settings.roots) continue;
    for (std::uint32_t i = mesh.firstIndex[c]; i < mesh.firstIndex[c + 1]; ++i) {
      geometry.indices.push_back(first + mesh.indices[i]);
    }
  }
}

Result<PlantGeometry> geometryOf(const SkeletonGraph& graph, const SurfaceSettings& settings, const QString& format,
                                 Progress& progress, WoodMesh wood) {
  if (graph.segments.empty()) return Error{"holds no stems"};
  PlantGeometry geometry;
  geometry.format = format;
  geometry.wood = wood;
  geometry.nodes = static_cast<int>(graph.segments.size() + graph.leaves.size() + graph.buds.size());
  geometry.maxInfluences = 2;
  SkeletonGraph own = graph;
  for (Segment& s : own.segments) s.bone = -1;
  const std::shared_ptr<const PlantSkeleton> skeleton = makeSkeleton(own, settings, ringSettings(settings));
  progress.report(0.4);
  if (progress.cancelled()) return Error{"cancelled", true};
  addBones(*skeleton, geometry);
  if (wood == WoodMesh::Whole) addSurface(*skeleton, meshSettings(settings), geometry);
  geometry.materials.push_back(barkMaterial(settings.bark));
  geometry.parts.push_back({0, static_cast<std::uint32_t>(geometry.indices.size()), 0, false});
  progress.report(0.8);
  if (progress.cancelled()) return Error{"cancelled", true};
  addOrgans(*skeleton, geometry);
  geometry.skeleton = skeleton;
  progress.report(1);
  return geometry;
}

SkeletonGraph graphOf(const PlantGeometry& geometry) {
  SkeletonGraph graph;
  std::vector<std::int32_t> place(geometry.bones.size(), -1);
  for (std::size_t b = 0; b < geometry.bones.size(); ++b) {
    const Bone& bone = geometry.bones[b];
    const std::int32_t above = bone.parent < 0 ? -1 : place[at(bone.parent)];
    place[b] = above;
    if (!bone.weighted) continue;
    Segment s;
    s.a = bone.head, s.b = bone.tail;
    s.ra = s.rb = bone.radius;
    s.parent = above;
    s.bone = static_cast<std::int32_t>(b);
    place[b] = static_cast<std::int32_t>(graph.segments.size());
    graph.segments.push_back(s);
  }
  finishGraph(graph);
  return graph;
}

namespace {

void enlarge(PlantGeometry& geometry, float k) {
  for (Bone& bone : geometry.bones) bone.head *= k, bone.tail *= k, bone.radius *= k;
  for (Vertex& vertex : geometry.vertices) vertex.position *= k;
  for (sim::LeafSite& site : geometry.leafSites) site.position *= k, site.size *= k;
}

}  // namespace

Result<PlantGeometry> withSurface(PlantGeometry geometry, const SurfaceSettings& settings, Progress& progress,
                                  WoodMesh wood) {
  SurfaceSettings unscaled = settings;
  unscaled.scale = 1;
  if (settings.scale != 1) enlarge(geometry, static_cast<float>(settings.scale));
  const SkeletonGraph graph = graphOf(geometry);
  if (graph.segments.empty()) return geometry;
  const std::shared_ptr<const PlantSkeleton> skeleton = makeSkeleton(graph, unscaled, ringSettings(settings));
  progress.report(0.5);
  if (progress.cancelled()) return Error{"cancelled", true};
  continueBones(*skeleton, geometry.bones);
  geometry.skeleton = skeleton;
  if (!settings.fromSkeleton) return geometry;

  geometry.vertices.clear();
  geometry.indices.clear();
  geometry.parts.clear();
  geometry.materials = {barkMaterial(settings.bark)};
  geometry.wood = wood;
  if (wood == WoodMesh::Whole) addSurface(*skeleton, meshSettings(settings), geometry);
  geometry.parts.push_back({0, static_cast<std::uint32_t>(geometry.indices.size()), 0, false});
  progress.report(1);
  return geometry;
}

}  // namespace windfall::model
