#include <QJsonArray>
#include <algorithm>
#include <cmath>

#include "model/leaf/atlas.h"

namespace windfall::model {

namespace {

double rounded(double value) { return std::round(value * 1e6) / 1e6; }

/// Places in metres from the pivot (x right, y to the tip), texture coordinates in the atlas.
QJsonObject meshJson(const Atlas& atlas, size_t index, const LeafMesh& mesh) {
  const LeafTexture& texture = atlas.textures[index];
  const double length = texture.metres.height() * std::clamp(texture.pivot.y(), 0.1, 1.0);
  QJsonArray positions, uvs, ribs, indices;
  for (const LeafVertex& vertex : mesh.vertices) {
    positions.append(rounded(static_cast<double>(vertex.place.x) * length));
    positions.append(rounded(static_cast<double>(vertex.place.y) * length));
    const QPointF uv = atlas.toAtlas(index, {static_cast<double>(vertex.uv.x), static_cast<double>(vertex.uv.y)});
    uvs.append(rounded(uv.x()));
    uvs.append(rounded(uv.y()));
    ribs.append(rounded(static_cast<double>(vertex.rib) * length));
  }
  for (const std::uint32_t corner : mesh.indices) indices.append(static_cast<qint64>(corner));
  return {{"triangles", static_cast<qint64>(mesh.indices.size() / 3)},
          {"positions", positions},
          {"uvs", uvs},
          {"fromMidrib", ribs},
          {"indices", indices}};
}

}  // namespace

QJsonObject describe(const Atlas& atlas) {
  QJsonArray leaves;
  for (size_t i = 0; i < atlas.places.size(); ++i) {
    const QRect& r = atlas.places[i];
    const LeafTexture& texture = atlas.textures[i];
    const double width = std::max(1, atlas.image.width()), height = std::max(1, atlas.image.height());
    const QPointF pivot = atlas.toAtlas(i, texture.pivot);
    QJsonObject leaf{
        {"name", texture.name},
        {"rectangle", QJsonArray{r.x(), r.y(), r.width(), r.height()}},
        {"uv", QJsonArray{r.x() / width, r.y() / height, (r.x() + r.width()) / width, (r.y() + r.height()) / height}},
        {"turned", static_cast<bool>(atlas.turned[i])},
        {"pivot", QJsonArray{texture.pivot.x(), texture.pivot.y()}},
        {"pivotUv", QJsonArray{pivot.x(), pivot.y()}},
        {"metres", QJsonArray{texture.metres.width(), texture.metres.height()}},
    };
    QJsonArray levels;
    for (const LeafMesh& mesh : texture.meshes) {
      if (!mesh.indices.empty()) levels.append(meshJson(atlas, i, mesh));
    }
    if (!levels.isEmpty()) leaf["meshes"] = levels;
    leaves.append(leaf);
  }
  return {{"size", QJsonArray{atlas.image.width(), atlas.image.height()}},
          {"origin", "top left"},
          {"scale", atlas.scale},
          {"leaves", leaves}};
}

}  // namespace windfall::model
