#include "widgets/render/bark_layers.h"

#include <algorithm>
#include <glm/gtc/color_space.hpp>

#include "widgets/render/mip_chain.h"

namespace windfall::render {

namespace {

constexpr int kSize = 512;             // px
constexpr std::size_t kMost = 256;     // link numbers keep 8 bits for the layer
constexpr float kBarkRelief = 0.012f;  // m, as of trees' meshes

}  // namespace

void Barks::bind() const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, looks.id());
  glBindTextureUnit(3, pictures.id());
}

const Material& BarkLayers::materialOf(int mesh) const {
  static const Material plain;
  const Mesh& from = content_.meshes[static_cast<std::size_t>(mesh)];
  for (const Part& part : from.parts) {
    if (part.adaptive) return from.materials[static_cast<std::size_t>(part.material)];
  }
  return from.materials.empty() ? plain : from.materials.front();
}

const Picture* BarkLayers::pictureOf(int mesh) const {
  const int picture = materialOf(mesh).picture;
  return picture < 0 ? nullptr
                     : &content_.meshes[static_cast<std::size_t>(mesh)].pictures[static_cast<std::size_t>(picture)];
}

std::uint32_t BarkLayers::layerOf(int mesh) {
  for (std::size_t i = 0; i < meshes_.size(); ++i) {
    if (meshes_[i] == mesh) return static_cast<std::uint32_t>(i);
    const Material &a = materialOf(meshes_[i]), &b = materialOf(mesh);
    const Picture *first = pictureOf(meshes_[i]), *second = pictureOf(mesh);
    const bool same = (first == nullptr && second == nullptr) ||
                      (first != nullptr && second != nullptr && first->rgba == second->rgba);
    if (same && a.baseColor == b.baseColor && a.roughness == b.roughness && a.tile == b.tile && a.twigs == b.twigs) {
      return static_cast<std::uint32_t>(i);
    }
  }
  if (meshes_.size() >= kMost) return 0;
  meshes_.push_back(mesh);
  return static_cast<std::uint32_t>(meshes_.size() - 1);
}

Barks BarkLayers::upload() const {
  Barks out;
  out.allPictured = !meshes_.empty();
  std::vector<vec4> looks;
  int levels = 1;
  while ((kSize >> levels) > 0) ++levels;
  out.pictures = makeTexture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(out.pictures.id(), levels, GL_SRGB8_ALPHA8, kSize, kSize,
                     std::max<GLsizei>(1, static_cast<GLsizei>(meshes_.size())));
  for (std::size_t i = 0; i < meshes_.size(); ++i) {
    const Material& material = materialOf(meshes_[i]);
    const Picture* picture = pictureOf(meshes_[i]);
    looks.emplace_back(vec3(material.baseColor), material.tile);
    looks.emplace_back(material.roughness, picture != nullptr ? 1.0f : 0.0f, 0.0f, kBarkRelief);
    looks.push_back(material.twigs);
    out.allPictured = out.allPictured && picture != nullptr;
    if (picture == nullptr) {
      looks.emplace_back(1);
      continue;
    }
    const std::vector<MipLevel> chain = mipChain(*picture, kSize, kSize, false);
    for (std::size_t level = 0; level < chain.size(); ++level) {
      glTextureSubImage3D(out.pictures.id(), static_cast<GLint>(level), 0, 0, static_cast<GLint>(i), chain[level].width,
                          chain[level].height, 1, GL_RGBA, GL_UNSIGNED_BYTE, chain[level].rgba.data());
    }
    const std::vector<std::uint8_t>& mean = chain.back().rgba;
    looks.push_back(glm::convertSRGBToLinear(vec4(mean[0], mean[1], mean[2], mean[3]) / 255.0f));
  }
  glTextureParameteri(out.pictures.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  if (looks.empty()) looks.resize(4, vec4(0));
  out.looks = makeBuffer(static_cast<GLsizeiptr>(looks.size() * sizeof(vec4)), looks.data(), 0);
  return out;
}

}  // namespace windfall::render
