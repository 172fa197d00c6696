#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <QRegularExpression>
#include <algorithm>
#include <cstring>

#include "model/plant/assimp_private.h"

namespace windfall::model::assimp {

namespace {

const vec4 kPlainWood(0.17f, 0.12f, 0.085f, 1);  // linear

/// A picture inside the file; pictures beside it are not looked for, since a source is bytes without a folder, but
/// noted.
QImage embeddedPicture(const aiScene& scene, const aiMaterial& material, QStringList& notes) {
  aiString path;
  const bool named = material.GetTexture(aiTextureType_BASE_COLOR, 0, &path) == aiReturn_SUCCESS ||
                     material.GetTexture(aiTextureType_DIFFUSE, 0, &path) == aiReturn_SUCCESS;
  const aiTexture* texture = named ? scene.GetEmbeddedTexture(path.C_Str()) : nullptr;
  if (texture == nullptr || texture->pcData == nullptr) {
    const QString name = QString::fromUtf8(path.C_Str()).section(QRegularExpression(QStringLiteral("[/\\\\]")), -1);
    if (named) notes << QStringLiteral("its picture \"%1\" is not inside the file: embed it").arg(name.left(60));
    return {};
  }
  if (texture->mHeight == 0) {
    QImage image;
    image.loadFromData(reinterpret_cast<const uchar*>(texture->pcData), static_cast<int>(texture->mWidth));
    return image.isNull() ? image : image.convertToFormat(QImage::Format_RGBA8888);
  }
  if (texture->mWidth > 32768 || texture->mHeight > 32768) return {};
  QImage image(static_cast<int>(texture->mWidth), static_cast<int>(texture->mHeight), QImage::Format_RGBA8888);
  for (int y = 0; y < image.height(); ++y) {
    uchar* row = image.scanLine(y);
    for (int x = 0; x < image.width(); ++x) {
      const aiTexel& texel =
          texture->pcData[static_cast<std::size_t>(y) * texture->mWidth + static_cast<std::size_t>(x)];
      const uchar pixel[4] = {texel.r, texel.g, texel.b, texel.a};
      std::memcpy(row + 4 * x, pixel, 4);
    }
  }
  return image;
}

}  // namespace

void readMaterials(const aiScene& scene, PlantGeometry& geometry) {
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    const aiMaterial& source = *scene.mMaterials[i];
    Material material;
    material.name = QString::fromUtf8(source.GetName().C_Str());
    aiColor4D color(0.5f, 0.5f, 0.5f, 1);
    if (source.Get(AI_MATKEY_BASE_COLOR, color) != aiReturn_SUCCESS) source.Get(AI_MATKEY_COLOR_DIFFUSE, color);
    material.baseColor = glm::clamp(vec4(color.r, color.g, color.b, color.a), 0.0f, 1.0f);
    float roughness = material.roughness;
    if (source.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) == aiReturn_SUCCESS) {
      material.roughness = std::clamp(roughness, 0.0f, 1.0f);
    }
    int twoSided = 0;
    source.Get(AI_MATKEY_TWOSIDED, twoSided);
    material.doubleSided = twoSided != 0;
    material.texture = embeddedPicture(scene, source, geometry.notes);
    // A mesh that was given no material is wood rather than white paint.
    const bool none = material.name.isEmpty() || material.name == QLatin1String(AI_DEFAULT_MATERIAL_NAME);
    if (none && material.texture.isNull()) material.baseColor = kPlainWood;
    geometry.materials.push_back(std::move(material));
  }
  if (geometry.materials.empty()) geometry.materials.emplace_back();
}

}  // namespace windfall::model::assimp
