#include <algorithm>
#include <cmath>

#include "model/leaf/atlas.h"
#include "model/leaf/shape_texture.h"

namespace windfall::model {

namespace {

/// The main vein from the petiole's end on, in shares of the image; empty where none is known.
std::vector<QPointF> midribOf(const LeafTexture& texture) {
  const Vein* longest = nullptr;
  double most = 0;
  for (const Vein& vein : texture.veins) {
    if (vein.order != 1 || vein.points.size() < 2) continue;
    const double rise = vein.points.front().y() - vein.points.back().y();
    if (rise > most) most = rise, longest = &vein;
  }
  const QSizeF size(texture.image.size());
  if (longest == nullptr || most < 0.3 * size.height()) return {};
  std::vector<QPointF> midrib{texture.pivot};
  for (const QPointF& p : longest->points) {
    const QPointF share(p.x() / size.width(), p.y() / size.height());
    // A fold cannot turn back.
    if (share.y() < midrib.back().y() - 0.01) midrib.push_back(share);
  }
  return midrib;
}

}  // namespace

Result<LeafMeshes> fitTexture(const LeafTexture& texture) {
  return fitLeafMeshes({texture.image, texture.pivot, midribOf(texture)});
}

Status dressTexture(LeafTexture& texture, const LeafParameters& parameters, quint64 seed) {
  texture.ageing = parameters.ageing;
  const LeafAge age = leafAge(parameters.ageing);
  MapSource source{texture.image, texture.veins, texture.root, seed, age.dryness(parameters.ageing.wetness)};
  if (parameters.ageing.age > 0) {
    // Where ageing comes first follows from the fresh leaf; the maps show the aged one.
    const LeafMaps fresh = makeMaps(source, parameters.maps);
    texture.image = source.image = agedTexture(texture.image, fresh.ageing, age, parameters.ageing);
  }
  texture.maps = makeMaps(source, parameters.maps);
  return shapeTexture(texture);
}

Status shapeTexture(LeafTexture& texture) {
  Result<LeafMeshes> meshes = fitTexture(texture);
  if (!meshes) return meshes.error();
  texture.meshes = std::move(*meshes);
  const double length = std::max(1.0, texture.pivot.y() * texture.image.height());
  texture.stalk = static_cast<float>(
      std::clamp((texture.pivot.y() * texture.image.height() - texture.root.y()) / length, 0.0, 0.6));
  float left = 0, right = 0;
  for (const LeafVertex& vertex : texture.meshes[0].vertices) {
    left = std::max(left, -vertex.rib);
    right = std::max(right, vertex.rib);
  }
  texture.halfWidth = std::max(0.05f, std::max(left, right));
  return ok();
}

}  // namespace windfall::model
