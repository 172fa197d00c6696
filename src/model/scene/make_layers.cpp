#include <future>

#include "model/export/kept_textures.h"
#include "model/plant/grow/species_leaf.h"
#include "model/progress_part.h"
#include "model/sample/leaf_painter.h"
#include "model/scene/assemble.h"
#include "model/scene/layer_plan.h"

namespace windfall::model {

namespace {

/// A plain green leaf for trees that have none of their own.
LeafTexture standIn() {
  constexpr int kSize = 512;
  constexpr double kBlade = 0.08;  // m
  const PaintedPhoto painted = paintLeafPhoto({}, 1, kSize);
  QImage image = painted.photo.convertToFormat(QImage::Format_RGBA8888);
  image.setAlphaChannel(painted.mask);
  LeafTexture texture = uprightTexture(QStringLiteral("stand-in"), image, painted.root, painted.tip, kBlade);
  // Painted leaves always have something opaque.
  static_cast<void>(dressTexture(texture, {}, 1));
  return texture;
}

}  // namespace

Result<std::vector<LeafTexture>> makeLayers(const Project& project, const LayerPlan& plan, Progress& progress) {
  std::map<AssetId, std::vector<LeafTexture>> ofLeaf;
  std::map<AssetId, std::map<std::size_t, std::size_t>> place;
  for (const LayerSource& layer : plan.layers) {
    if (layer.leaf) place[layer.leaf].emplace(layer.variant, 0);
  }
  double done = 0;
  for (auto& [id, variants] : place) {
    const Leaf& leaf = *project.leaf(id);
    const auto leaves = static_cast<double>(place.size());
    ProgressPart part(progress, done / leaves, (done + 1) / leaves);
    Result<std::vector<LeafTexture>> textures = keptTextures(leaf, part);
    if (!textures)
      return Error{"leaf \"" + leaf.name.toStdString() + "\": " + textures.error().message, part.cancelled()};
    std::size_t next = 0;
    for (auto& [variant, index] : variants) index = next++;
    if (textures->size() != next) return Error{"leaf \"" + leaf.name.toStdString() + "\" lost a variant"};
    ofLeaf[id] = std::move(*textures);
    done += 1;
  }
  std::vector<LeafTexture> layers;
  for (const LayerSource& layer : plan.layers) {
    constexpr double kBlade = 0.08;  // m; the picture is drawn in the size of each leaf
    layers.push_back(layer.leaf       ? ofLeaf[layer.leaf][place[layer.leaf][layer.variant]]
                     : layer.look < 0 ? standIn()
                                      : growth::speciesLeaf(static_cast<LeafLook>(layer.look),
                                                            static_cast<int>(layer.variant), kBlade));
  }
  return layers;
}

Result<SceneAssembly> assembleScene(const Project& project, Progress& progress, GeometryCache* shapes) {
  ProgressTogether together(progress);
  ProgressTogether::Work trees(together, 0.6), leaves(together, 0.4);
  auto layers = std::async(std::launch::async, [&] { return makeLayers(project, planLayers(project), leaves); });
  Result<SceneAssembly> assembly = assembleTrees(project, trees, shapes);
  if (!assembly) leaves.cancel();
  Result<std::vector<LeafTexture>> made = layers.get();
  if (!assembly) return assembly;
  if (!made) return made.error();
  assembly->leafTextures = std::move(*made);
  return assembly;
}

}  // namespace windfall::model
