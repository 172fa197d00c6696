#include "widgets/render/leaf_maps.h"

#include <algorithm>
#include <bit>
#include <string>

#include "widgets/render/leaf_meshes.h"
#include "widgets/render/mip_chain.h"

namespace windfall::render {

namespace {

constexpr std::size_t kArrayBytes = std::size_t{256} << 20;  // of the colours, without their mip levels

bool sound(const Picture& p) {
  return p.width > 0 && p.height > 0 &&
         p.rgba.size() == static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height) * 4;
}

/// Side of the layers: the largest picture's, a power of two, within the memory.
int layerSize(const std::vector<LeafLayer>& layers) {
  int wanted = 1, size = 16;
  for (const LeafLayer& layer : layers) wanted = std::max({wanted, layer.picture.width, layer.picture.height});
  while (size < std::min(wanted, 1024)) size *= 2;
  while (size > 64 && static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 4 * layers.size() > kArrayBytes)
    size /= 2;
  return size;
}

/// Numbers, averaged over what each texel of the target covers.
std::vector<std::uint8_t> resampledNumbers(const Picture& from, int side) {
  std::vector<std::uint8_t> to(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 4);
  std::size_t out = 0;
  for (int y = 0; y < side; ++y) {
    const int y0 = y * from.height / side, y1 = std::max(y0 + 1, (y + 1) * from.height / side);
    for (int x = 0; x < side; ++x) {
      const int x0 = x * from.width / side, x1 = std::max(x0 + 1, (x + 1) * from.width / side);
      unsigned sum[4]{}, count = 0;
      for (int sy = y0; sy < y1; ++sy) {
        for (int sx = x0; sx < x1; ++sx, ++count) {
          const std::size_t i =
              (static_cast<std::size_t>(sy) * static_cast<std::size_t>(from.width) + static_cast<std::size_t>(sx)) * 4;
          for (std::size_t c = 0; c < 4; ++c) sum[c] += from.rgba[i + c];
        }
      }
      for (std::size_t c = 0; c < 4; ++c) to[out++] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
    }
  }
  return to;
}

/// With all mipmaps.
Texture makeArray(int side, std::size_t layers, GLenum format) {
  return makeTextureArray(format, side, std::bit_width(static_cast<unsigned>(side)), layers);
}

/// One of the arrays of numbers; layers without such a picture get `plain`.
Texture numberArray(const std::vector<LeafLayer>& layers, Picture LeafLayer::*picture, int side, std::uint32_t plain) {
  int wanted = 4;
  for (const LeafLayer& layer : layers) {
    if (sound(layer.*picture)) wanted = side;
  }
  Texture array = makeArray(wanted, layers.size(), GL_RGBA8);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    std::vector<std::uint8_t> texels;
    if (sound(layers[i].*picture)) {
      texels = resampledNumbers(layers[i].*picture, wanted);
    } else {
      for (int k = 0; k < wanted * wanted; ++k) {
        for (unsigned c = 0; c < 4; ++c) texels.push_back(static_cast<std::uint8_t>(plain >> (24 - 8 * c)));
      }
    }
    glTextureSubImage3D(array.id(), 0, 0, 0, static_cast<GLint>(i), wanted, wanted, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                        texels.data());
  }
  glGenerateTextureMipmap(array.id());
  return array;
}

}  // namespace

void LeafMapArrays::reset() {
  colours_.reset();
  surfaces_.reset();
  ageing_.reset();
  covers_.clear();
}

Status LeafMapArrays::upload(const std::vector<LeafLayer>& layers) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
  if (layers.size() > static_cast<std::size_t>(most)) {
    return Error{std::to_string(layers.size()) + " leaf textures; this graphics device takes " + std::to_string(most)};
  }
  for (const LeafLayer& layer : layers) {
    if (!sound(layer.picture)) return Error{"a leaf texture is empty or its size is wrong"};
  }
  clearErrors();
  const int side = layerSize(layers);
  std::vector<LeafCover> covers;
  Texture colours = makeArray(side, layers.size(), GL_SRGB8_ALPHA8);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    GLint level = 0;
    const std::vector<MipLevel> levels = mipChain(layers[i].picture, side, side, true);
    covers.push_back(coverOf(levels, shapesOf(layers[i])));
    for (const MipLevel& from : levels) {
      glTextureSubImage3D(colours.id(), level++, 0, 0, static_cast<GLint>(i), from.width, from.height, 1, GL_RGBA,
                          GL_UNSIGNED_BYTE, from.rgba.data());
    }
  }
  const int half = std::max(64, side / 2);
  Texture surfaces = numberArray(layers, &LeafLayer::surface, half, 0x808085ffu);
  Texture ageing = numberArray(layers, &LeafLayer::ageing, half, 0x6b808cffu);
  if (outOfMemory()) return Error{"not enough graphics memory for the leaf textures"};
  colours_ = std::move(colours);
  surfaces_ = std::move(surfaces);
  ageing_ = std::move(ageing);
  covers_ = std::move(covers);
  return ok();
}

void LeafMapArrays::bind() const {
  glBindTextureUnit(3, colours_.id());
  glBindTextureUnit(4, surfaces_.id());
  glBindTextureUnit(5, ageing_.id());
}

}  // namespace windfall::render
