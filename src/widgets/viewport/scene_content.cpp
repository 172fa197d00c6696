#include "widgets/viewport/scene_content.h"

#include <algorithm>
#include <cstring>
#include <map>

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

render::Mesh makeMesh(const model::LoadedPlant& plant, float scale) {
  const model::PlantGeometry& geometry = *plant.geometry;
  const std::vector<std::uint32_t> links = movingLinks(plant);
  render::Mesh mesh;
  mesh.vertices.reserve(geometry.vertices.size());
  for (const model::Vertex& from : geometry.vertices) {
    render::Vertex to{from.position * scale, from.normal, from.uv, {}, {}};
    for (std::size_t k = 0; k < 4; ++k) {
      to.links[k] = from.bones[k] < links.size() ? links[from.bones[k]] : 0;
      to.weights[k] = from.weights[k];
    }
    mesh.vertices.push_back(to);
  }
  mesh.indices = geometry.indices;
  for (const model::MeshPart& part : geometry.parts) {
    if (!part.hidden) mesh.parts.push_back({part.firstIndex, part.indexCount, part.material});
  }
  for (const model::Material& from : geometry.materials) {
    render::Material to{from.baseColor, -1, from.roughness, from.leaf};
    if (!from.texture.isNull()) {
      to.picture = static_cast<int>(mesh.pictures.size());
      mesh.pictures.push_back(toPicture(from.texture));
    }
    mesh.materials.push_back(to);
  }
  return mesh;
}

/// Normal, roughness and what comes through, in one picture of numbers.
render::Picture surfaceOf(const model::LeafTexture& texture) {
  const model::LeafMaps& maps = texture.maps;
  if (maps.normal.isNull()) return {};
  render::Picture picture{maps.normal.width(), maps.normal.height(), {}};
  picture.rgba.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * 4);
  for (int y = 0; y < picture.height; ++y) {
    const uchar *normal = maps.normal.constScanLine(y), *rough = maps.roughness.constScanLine(y);
    const uchar* through = maps.thinness.constScanLine(y);
    for (int x = 0; x < picture.width; ++x) {
      picture.rgba.insert(picture.rgba.end(), {normal[4 * x], normal[4 * x + 1], rough[x], through[x]});
    }
  }
  return picture;
}

/// The ageing map with the occlusion in its last channel.
render::Picture ageingOf(const model::LeafTexture& texture) {
  if (texture.maps.ageing.isNull()) return {};
  render::Picture picture = toPicture(texture.maps.ageing);
  for (int y = 0; y < picture.height; ++y) {
    const uchar* open = texture.maps.occlusion.constScanLine(y);
    for (int x = 0; x < picture.width; ++x) {
      picture
          .rgba[(static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x)) *
                    4 +
                3] = open[x];
    }
  }
  return picture;
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
  layer.surface = surfaceOf(texture);
  layer.ageing = ageingOf(texture);
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
    if (isNew) content.meshes.push_back(makeMesh(assembly.plants.at(placement->plant), scale));
    const auto links = static_cast<std::uint32_t>(assembly.sim.trees[i].tree->links.size());
    content.trees.push_back({mesh->second, static_cast<std::uint32_t>(content.linkCount), links});
    content.linkCount += links;
  }
  for (const model::LeafTexture& texture : assembly.leafTextures) content.leafLayers.push_back(makeLayer(texture));
  content.leafCount = leafCount;
  return content;
}

}  // namespace windfall::widgets
