#include "widgets/viewport/scene_content.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>

#include "model/plant/detail_mesh.h"
#include "model/plant/skeleton_geometry.h"

namespace windfall::widgets {
namespace {

/// The link that moves each bone: its own, or that of its nearest ancestor with one.
std::vector<std::uint32_t> movingLinks(const model::LoadedPlant& plant) {
  const auto& bones = plant.geometry->bones;
  const auto& linkOfBone = plant.bodies->linkOfBone;
  std::vector<std::uint32_t> links(bones.size(), 0);
  for (std::size_t i = 0; i < bones.size(); ++i) {
    if (linkOfBone[i] >= 0) {
      links[i] = static_cast<std::uint32_t>(linkOfBone[i]);
    } else if (bones[i].parent >= 0) {
      links[i] = links[static_cast<std::size_t>(bones[i].parent)];
    }
  }
  return links;
}

/// Whether the plant's mesh was made from its skeleton; an imported one keeps its own unless the artist says.
bool followsSkeleton(const model::PlantGeometry& geometry) {
  static const QStringList kMeshes{QStringLiteral("fbx"), QStringLiteral("glb"), QStringLiteral("gltf")};
  return geometry.skeleton && (geometry.skeleton->settings.fromSkeleton || !kMeshes.contains(geometry.format));
}

bool isTwig(const model::PlantGeometry& geometry, int material) {
  return geometry.materials[static_cast<std::size_t>(material)].thinner > 0;
}

/// Colour and greatest radius (m) of stems that a grower drew without bark; 0: none.
vec4 twigsOf(const model::PlantGeometry& geometry, float scale) {
  const auto twig = std::ranges::find_if(geometry.materials, [](const auto& material) { return material.thinner > 0; });
  if (twig == geometry.materials.end()) return vec4(0);
  float thickest = 0;
  for (const model::Bone& bone : geometry.bones) {
    if (bone.radius < twig->thinner) thickest = std::max(thickest, bone.radius);
  }
  return {vec3(twig->baseColor), thickest * scale};
}

/// Without `wood` the parts that an adaptive mesh stands for stay empty.
render::Mesh makeMesh(const model::LoadedPlant& plant, float scale, bool wood) {
  const model::PlantGeometry& geometry = *plant.geometry;
  const std::vector<std::uint32_t> links = movingLinks(plant);
  render::Mesh mesh;
  const auto add = [&](const model::Vertex& from) {
    render::Vertex to{from.position * scale, from.normal, from.uv, {}, {}, from.repeats, {}};
    std::copy(from.tint.begin(), from.tint.end(), to.tint);
    for (std::size_t k = 0; k < 4; ++k) {
      to.links[k] = from.bones[k] < links.size() ? links[from.bones[k]] : 0;
      to.weights[k] = from.weights[k];
    }
    mesh.vertices.push_back(to);
  };
  std::vector<std::uint32_t> place;
  if (wood) {
    mesh.vertices.reserve(geometry.vertices.size());
    for (const model::Vertex& vertex : geometry.vertices) add(vertex);
    mesh.indices = geometry.indices;
  } else {
    place.assign(geometry.vertices.size(), ~0u);
  }
  for (const model::MeshPart& part : geometry.parts) {
    // The first material of a skeleton's surface is its bark, a grower's second that of its twigs.
    const bool adaptive = followsSkeleton(geometry) && (part.material == 0 || isTwig(geometry, part.material));
    if (part.hidden) continue;
    if (wood) {
      mesh.parts.push_back(
          {part.firstIndex, part.indexCount, part.material, adaptive, part.pieces, part.width * scale});
      continue;
    }
    const auto first = static_cast<std::uint32_t>(mesh.indices.size());
    for (std::uint32_t i = part.firstIndex; !adaptive && i < part.firstIndex + part.indexCount; ++i) {
      std::uint32_t& to = place[geometry.indices[i]];
      if (to == ~0u) {
        to = static_cast<std::uint32_t>(mesh.vertices.size());
        add(geometry.vertices[geometry.indices[i]]);
      }
      mesh.indices.push_back(to);
    }
    mesh.parts.push_back({first, static_cast<std::uint32_t>(mesh.indices.size()) - first, part.material, adaptive,
                          part.pieces, part.width * scale});
  }
  for (const model::Material& from : geometry.materials) {
    render::Material to{from.baseColor, -1, from.roughness, from.leaf};
    if (followsSkeleton(geometry)) to.tile = static_cast<float>(geometry.skeleton->settings.tile) * scale;
    if (followsSkeleton(geometry) && mesh.materials.empty()) to.twigs = twigsOf(geometry, scale);
    if (!from.texture.isNull()) {
      to.picture = static_cast<int>(mesh.pictures.size());
      mesh.pictures.push_back(toPicture(from.texture));
    }
    mesh.materials.push_back(to);
  }
  return mesh;
}

/// Maps are smoother than colours: half the size shows the same.
QImage half(const QImage& map) {
  return map
      .scaled(std::max(1, map.width() / 2), std::max(1, map.height() / 2), Qt::IgnoreAspectRatio,
              Qt::SmoothTransformation)
      .convertToFormat(map.format());
}

/// Four channels of maps in one picture of numbers; each a map and its channel (of one in a byte a pixel: 0).
render::Picture channels(const std::array<std::pair<const QImage*, int>, 4>& from) {
  render::Picture picture;
  for (std::size_t c = 0; c < 4; ++c) {
    const QImage map = half(*from[c].first);
    const int step = map.depth() / 8;
    picture.width = map.width();
    picture.height = map.height();
    picture.rgba.resize(static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height()) * 4);
    std::size_t at = c;
    for (int y = 0; y < map.height(); ++y) {
      const uchar* row = map.constScanLine(y) + from[c].second;
      for (int x = 0; x < map.width(); ++x, at += 4) picture.rgba[at] = row[x * step];
    }
  }
  return picture;
}

/// A copy without alpha, which would weigh the colours when they are averaged.
QImage opaque(const QImage& map) { return map.convertToFormat(QImage::Format_RGBX8888); }

render::Picture surfaceOf(const model::LeafMaps& maps) {
  if (maps.normal.isNull()) return {};
  const QImage normal = opaque(maps.normal);
  return channels({{{&normal, 0}, {&normal, 1}, {&maps.roughness, 0}, {&maps.thinness, 0}}});
}

render::Picture ageingOf(const model::LeafMaps& maps) {
  if (maps.ageing.isNull()) return {};
  const QImage ageing = opaque(maps.ageing);
  return channels({{{&ageing, 0}, {&ageing, 1}, {&ageing, 2}, {&maps.occlusion, 0}}});
}

void addAgeing(const model::LeafTexture& texture, render::LeafLayer& layer) {
  const auto gains = model::ageGains(texture.image, texture.ageing);
  for (std::size_t i = 0; i < 3; ++i) layer.gains[i] = {gains[i][0], gains[i][1], gains[i][2]};
  for (std::size_t i = 0; i < render::kSeasonSamples; ++i) {
    const double season = static_cast<double>(i) / (render::kSeasonSamples - 1);
    const model::SeasonStates states = model::statesAfter(model::seasonDays(season), texture.ageing);
    layer.seasons[i] = vec4(states[0], states[1], states[2], states[3]);
  }
  layer.redness = static_cast<float>(std::min(1.0, 1.6 * texture.ageing.redness));
  layer.wetness = static_cast<float>(texture.ageing.wetness);
}

/// The adaptive mesh of a plant whose curves are known; else one without runs.
std::shared_ptr<const DetailMesh> makeDetail(const model::LoadedPlant& plant, float scale) {
  const std::shared_ptr<const model::PlantSkeleton>& skeleton = plant.geometry->skeleton;
  if (!followsSkeleton(*plant.geometry)) return std::make_shared<DetailMesh>();
  model::DetailSource source;
  source.roots = skeleton->settings.roots;
  for (const model::Segment& segment : skeleton->graph.segments) {
    const int link = segment.bone < 0 ? 0 : plant.bodies->carrierOfBone[static_cast<std::size_t>(segment.bone)];
    source.linkOfSegment.push_back(link);
    const float wood = segment.state.wood < 0 ? 1 : std::clamp(segment.state.wood, 0.0f, 1.0f);
    source.tint.push_back(0xffffffu | static_cast<std::uint32_t>(std::lround(wood * 255)) << 24);
  }
  DetailMesh mesh = model::makeDetail(skeleton->graph, skeleton->chains, skeleton->curves, skeleton->rings, source);
  return std::make_shared<DetailMesh>(scale == 1 ? std::move(mesh) : model::scaled(std::move(mesh), scale));
}

render::LeafLayer makeLayer(const model::LeafTexture& texture) {
  const double width = std::max(texture.metres.width(), 1e-4), height = std::max(texture.metres.height(), 1e-4);
  // The petiole hangs at the pivot and the tip touches the upper border: between them lies one leaf's length.
  const double length = height * std::clamp(texture.pivot.y(), 0.1, 1.0);
  render::LeafLayer layer;
  layer.picture = toPicture(texture.image);
  layer.pivot = {static_cast<float>(texture.pivot.x()), static_cast<float>(texture.pivot.y())};
  layer.extent = {static_cast<float>(width / length), static_cast<float>(height / length)};
  for (std::size_t level = 0; level < layer.levels.size(); ++level) {
    for (const model::LeafVertex& vertex : texture.meshes[level].vertices) {
      layer.levels[level].corners.push_back({vertex.place, vertex.rib, vertex.uv});
    }
    layer.levels[level].indices = texture.meshes[level].indices;
  }
  layer.surface = surfaceOf(texture.maps);
  layer.ageing = ageingOf(texture.maps);
  layer.stalk = texture.stalk;
  layer.halfWidth = texture.halfWidth;
  addAgeing(texture, layer);
  return layer;
}

}  // namespace

render::Picture toPicture(const QImage& image) {
  if (image.isNull()) return {};
  const QImage rgba = image.convertToFormat(QImage::Format_RGBA8888);
  render::Picture picture{rgba.width(), rgba.height(), {}};
  const auto row = static_cast<std::size_t>(rgba.width()) * 4;
  picture.rgba.resize(row * static_cast<std::size_t>(rgba.height()));
  for (int y = 0; y < rgba.height(); ++y) {
    std::memcpy(picture.rgba.data() + row * static_cast<std::size_t>(y), rgba.constScanLine(y), row);
  }
  return picture;
}

render::SceneContent makeContent(const model::SceneAssembly& assembly, const model::Scene& scene,
                                 std::size_t leafCount) {
  render::SceneContent content;
  std::map<std::pair<model::AssetId, float>, int> meshes;
  for (std::size_t i = 0; i < assembly.trees.size(); ++i) {
    const auto placement = std::find_if(scene.trees.begin(), scene.trees.end(),
                                        [&](const model::TreePlacement& t) { return t.id == assembly.trees[i]; });
    if (placement == scene.trees.end()) continue;
    const auto scale = static_cast<float>(placement->scale);
    const auto [mesh, isNew] = meshes.try_emplace({placement->plant, scale}, static_cast<int>(content.meshes.size()));
    if (isNew) {
      const model::LoadedPlant& plant = assembly.plants.at(placement->plant);
      content.details.push_back(makeDetail(plant, scale));
      const bool wood = !scene.detail.adaptive || content.details.back()->entries.empty();
      content.meshes.push_back(makeMesh(plant, scale, wood));
    }
    const auto links = static_cast<std::uint32_t>(assembly.sim.trees[i].tree->links.size());
    const int detail = content.details[static_cast<std::size_t>(mesh->second)]->entries.empty() ? -1 : mesh->second;
    content.trees.push_back({mesh->second, static_cast<std::uint32_t>(content.linkCount), links, detail});
    content.leafTrees.push_back(assembly.sim.trees[i].tree);
    content.linkCount += links;
  }
  content.leafSeed = assembly.sim.seed;
  for (const model::LeafTexture& texture : assembly.leafTextures) content.leafLayers.push_back(makeLayer(texture));
  content.leafCount = leafCount;
  return content;
}

}  // namespace windfall::widgets
