#include "model/export/plant_model.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "model/export/leaf_cards.h"
#include "model/leaf/ageing.h"
#include "model/leaf/leaf_mesh.h"
#include "model/plant/bodies.h"
#include "model/plant/frames.h"
#include "model/plant/import.h"
#include "model/plant/skeleton_geometry.h"
#include "model/progress_part.h"
#include "model/scene/assemble.h"
#include "model/scene/layer_plan.h"

namespace windfall::model {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

constexpr std::size_t kManyMergedLeaves = 5000;

/// Place in LeafMeshes.
std::size_t levelOf(const PlantExportOptions& options, std::size_t leaves) {
  if (options.leafMesh != LeafExportMesh::Automatic) {
    return static_cast<std::size_t>(options.leafMesh) - static_cast<std::size_t>(LeafExportMesh::Fine);
  }
  return options.leaves == LeafExport::Merged && leaves > kManyMergedLeaves ? 2 : 1;
}

LeafShape shapeOf(const LeafTexture& texture, std::size_t level) {
  LeafShape shape;
  shape.name = texture.name;
  shape.image = texture.image;
  shape.normalMap = texture.maps.normal;
  LeafMeshes meshes = texture.meshes;
  if (meshes[level].vertices.empty()) {
    if (Result<LeafMeshes> fitted = fitTexture(texture)) meshes = std::move(*fitted);
  }
  const float dryness = static_cast<float>(leafAge(texture.ageing).dryness(texture.ageing.wetness));
  const LeafBend bent = bendOf(dryness, 0, texture.stalk, texture.halfWidth);
  for (const LeafVertex& vertex : meshes[level].vertices) {
    // Hull and rectangle have no vertices on the midrib that they could fold at.
    const BentPoint point = level < 2 ? bend(vertex, bent) : BentPoint{vec3(vertex.place, 0)};
    shape.positions.push_back(point.position);
    shape.normals.push_back(glm::normalize(point.normal));
    shape.uvs.push_back(vertex.uv);
  }
  shape.indices = meshes[level].indices;
  return shape;
}

/// Only what is drawn, vertices that nothing uses left out.
void dropHidden(PlantGeometry& geometry) {
  std::vector<std::uint32_t> indices, place(geometry.vertices.size(), ~0u);
  std::vector<Vertex> vertices;
  std::vector<MeshPart> parts;
  for (MeshPart part : geometry.parts) {
    if (part.hidden || part.indexCount == 0) continue;
    const std::uint32_t first = part.firstIndex;
    part.firstIndex = static_cast<std::uint32_t>(indices.size());
    for (std::uint32_t i = 0; i < part.indexCount; ++i) {
      std::uint32_t& to = place[geometry.indices[first + i]];
      if (to == ~0u) {
        to = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(geometry.vertices[geometry.indices[first + i]]);
      }
      indices.push_back(to);
    }
    parts.push_back(part);
  }
  geometry.vertices = std::move(vertices);
  geometry.indices = std::move(indices);
  geometry.parts = std::move(parts);
}

/// The plant alone, with the leaves that hang on it.
Project alone(const Project& project, const Plant& plant) {
  Project result;
  result.plants = {plant};
  for (const Leaf& leaf : project.leaves) {
    if (std::find(plant.leaves.begin(), plant.leaves.end(), leaf.id) != plant.leaves.end()) {
      result.leaves.push_back(leaf);
    }
  }
  return result;
}

/// Sites of bones from those of links, with their layers.
void placeSites(const PlantBodies& bodies, PlantGeometry& geometry) {
  geometry.leafSites.clear();
  for (sim::LeafSite site : bodies.tree.sites) {
    const sim::Link& link = bodies.tree.links[at(site.link)];
    const int bone = bodies.boneOfLink[at(site.link)];
    const Bone& b = geometry.bones[at(bone)];
    const quat back = glm::conjugate(alongZ(b.tail - b.head));
    site.position = back * (link.joint + link.rotation * site.position - b.head);
    site.rotation = glm::normalize(back * link.rotation * site.rotation);
    site.link = bone;
    geometry.leafSites.push_back(site);
  }
}

/// Clusters of the leaves for crossed cards; the bones that carry them are appended as further sites.
std::vector<CardPlace> clustersOf(const PlantBodies& bodies, PlantGeometry& geometry) {
  sim::ClusterLimits limits;
  limits.reach = 9;
  limits.sites = 200;
  limits.most = 90;
  const sim::LeafClusters clusters = sim::clusterLeaves(bodies.tree, limits);
  std::vector<CardPlace> places = clusters.nodes.empty() ? std::vector<CardPlace>() : cardPlaces(clusters);
  for (std::size_t i = 0; i < places.size(); ++i) {
    sim::LeafSite site;
    site.link = bodies.boneOfLink[at(clusters.nodes[clusters.boughs + i].link)];
    geometry.leafSites.push_back(site);
  }
  return places;
}

Result<PlantGeometry> load(Plant plant, double detail, Progress& progress) {
  plant.surface.bakeRepeats = true;
  if (detail >= 0) plant.surface.detail = detail;
  return loadGeometry(plant, progress);
}

}  // namespace

Result<PlantModel> modelOf(const Project& project, AssetId id, const PlantExportOptions& options, Progress& progress) {
  const Plant* plant = project.plant(id);
  if (plant == nullptr) return Error{"there is no such plant"};
  const auto about = [&](const Error& error) {
    return Error{"plant “" + plant->name.toStdString() + "”: " + error.message, error.cancelled};
  };
  PlantModel model;
  model.name = plant->name;
  ProgressPart loading(progress, 0, 0.4), leaves(progress, 0.4, 0.7);
  Result<PlantGeometry> geometry = load(*plant, options.detail, loading);
  if (!geometry) return about(geometry.error());
  model.geometry = std::move(*geometry);
  if (model.geometry.bones.empty()) return about(Error{"has no bones"});
  model.clips = model.geometry.clips;
  for (const Clip& clip : plant->clips) {
    std::erase_if(model.clips, [&](const Clip& own) { return own.name == clip.name; });
    model.clips.push_back(clip);
  }
  dropHidden(model.geometry);
  std::vector<CardPlace> cards;
  if (options.leaves != LeafExport::None) {
    const Project own = alone(project, *plant);
    const LayerPlan plan = planLayers(own);
    const LayerRange range = plan.ofPlant.at(id);
    const PlantBodies bodies = buildBodies(model.geometry, *plant, range.first, range.count);
    placeSites(bodies, model.geometry);
    if (options.levels > 1) cards = clustersOf(bodies, model.geometry);
    Result<std::vector<LeafTexture>> textures = makeLayers(own, plan, leaves);
    if (!textures) return about(textures.error());
    const std::size_t level = levelOf(options, model.geometry.leafSites.size());
    for (const LeafTexture& texture : *textures) model.shapes.push_back(shapeOf(texture, level));
  } else {
    model.geometry.leafSites.clear();
  }
  if (progress.cancelled()) return Error{"cancelled", true};
  std::vector<Clip> none;
  for (int level = 1; level < options.levels; ++level) {
    const double detail = options.detail >= 0 ? options.detail : plant->surface.detail;
    ProgressPart part(progress, 0.7, 0.9);
    Result<PlantGeometry> coarser = load(*plant, std::max(0.0, detail - 0.33 * level), part);
    if (!coarser) return about(coarser.error());
    dropHidden(*coarser);
    coarser->leafSites.clear();
    reduceBones(*coarser, none, options.bones);
    model.coarser.push_back(std::move(*coarser));
  }
  reduceBones(model.geometry, model.clips, options.bones);
  // The last sites say which bones carry the cards.
  const std::size_t leafCount = model.geometry.leafSites.size() - cards.size();
  for (std::size_t i = 0; i < cards.size(); ++i) cards[i].bone = model.geometry.leafSites[leafCount + i].link;
  model.geometry.leafSites.resize(leafCount);
  for (const sim::LeafSite& site : model.geometry.leafSites) {
    const Bone& bone = model.geometry.bones[at(site.link)];
    const quat frame = alongZ(bone.tail - bone.head);
    model.leaves.push_back({site.link, static_cast<int>(site.layer), bone.head + frame * site.position,
                            glm::normalize(frame * site.rotation), site.size});
  }
  model.cards = paintCards(model.shapes, model.leaves, cards);
  progress.report(0.9);
  return model;
}

}  // namespace windfall::model
