#include "widgets/render/mip_chain.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace windfall::render {

namespace {

constexpr int kLeastShape = 8;  // texels; as blurred() in leaf_layers.glsl

/// Linear, premultiplied.
struct Image {
  int width = 0, height = 0;
  std::vector<vec4> texels;
};

const std::array<float, 256>& linearOfByte() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (int i = 0; i < 256; ++i) {
      const double s = i / 255.0;
      values[static_cast<std::size_t>(i)] =
          static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
    }
    return values;
  }();
  return table;
}

/// Encodes by a table over the square root of the linear value, which is fine enough for 8 bits everywhere.
std::uint8_t byteOfLinear(float value) {
  static const std::array<std::uint8_t, 4096> table = [] {
    std::array<std::uint8_t, 4096> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const double root = static_cast<double>(i) / 4095.0, v = root * root;
      const double s = v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
      bytes[i] = static_cast<std::uint8_t>(std::lround(s * 255));
    }
    return bytes;
  }();
  return table[static_cast<std::size_t>(std::lround(std::sqrt(std::clamp(value, 0.f, 1.f)) * 4095.f))];
}

Image linear(const Picture& picture) {
  Image image{picture.width, picture.height, {}};
  const std::size_t count = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  image.texels.resize(count);
  const auto& table = linearOfByte();
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* p = &picture.rgba[i * 4];
    const float alpha = static_cast<float>(p[3]) / 255.f;
    image.texels[i] = {table[p[0]] * alpha, table[p[1]] * alpha, table[p[2]] * alpha, alpha};
  }
  return image;
}

/// Source texels and their weights for one target texel along one axis: area when shrinking, bilinear when growing.
struct Taps {
  int first = 0;
  std::vector<float> weights;
};

std::vector<Taps> tapsFor(int source, int target) {
  std::vector<Taps> taps(static_cast<std::size_t>(target));
  const double scale = static_cast<double>(source) / target, reach = std::max(scale, 1.0);
  for (int i = 0; i < target; ++i) {
    const double center = (i + 0.5) * scale - 0.5;
    const int first = std::max(0, static_cast<int>(std::ceil(center - reach)));
    const int last = std::min(source - 1, static_cast<int>(std::floor(center + reach)));
    Taps& tap = taps[static_cast<std::size_t>(i)];
    tap.first = std::min(first, source - 1);
    double sum = 0;
    for (int s = tap.first; s <= last; ++s) {
      const double weight = std::max(0.0, 1 - std::abs(s - center) / reach);
      tap.weights.push_back(static_cast<float>(weight));
      sum += weight;
    }
    if (sum <= 0) {
      tap.weights.assign(1, 1.f);
      continue;
    }
    for (float& weight : tap.weights) weight = static_cast<float>(weight / sum);
  }
  return taps;
}

Image resampled(const Image& image, int width, int height) {
  if (image.width == width && image.height == height) return image;
  Image rows{width, image.height,
             std::vector<vec4>(static_cast<std::size_t>(width) * static_cast<std::size_t>(image.height))};
  const auto across = tapsFor(image.width, width), down = tapsFor(image.height, height);
  for (int y = 0; y < image.height; ++y) {
    const vec4* source = &image.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width)];
    for (int x = 0; x < width; ++x) {
      const Taps& tap = across[static_cast<std::size_t>(x)];
      vec4 sum(0);
      for (std::size_t k = 0; k < tap.weights.size(); ++k)
        sum += source[static_cast<std::size_t>(tap.first) + k] * tap.weights[k];
      rows.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] = sum;
    }
  }
  Image out{width, height,
            std::vector<vec4>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), vec4(0))};
  for (int y = 0; y < height; ++y) {
    const Taps& tap = down[static_cast<std::size_t>(y)];
    vec4* target = &out.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)];
    for (std::size_t k = 0; k < tap.weights.size(); ++k) {
      const vec4* source = &rows.texels[(static_cast<std::size_t>(tap.first) + k) * static_cast<std::size_t>(width)];
      for (int x = 0; x < width; ++x) target[x] += source[x] * tap.weights[k];
    }
  }
  return out;
}

Image halved(const Image& image) {
  Image out{std::max(1, image.width / 2), std::max(1, image.height / 2), {}};
  out.texels.reserve(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  for (int y = 0; y < out.height; ++y) {
    const int y0 = std::min(2 * y, image.height - 1), y1 = std::min(2 * y + 1, image.height - 1);
    for (int x = 0; x < out.width; ++x) {
      const int x0 = std::min(2 * x, image.width - 1), x1 = std::min(2 * x + 1, image.width - 1);
      const auto at = [&](int px, int py) {
        return image.texels[static_cast<std::size_t>(py) * static_cast<std::size_t>(image.width) +
                            static_cast<std::size_t>(px)];
      };
      out.texels.push_back((at(x0, y0) + at(x1, y0) + at(x0, y1) + at(x1, y1)) * 0.25f);
    }
  }
  return out;
}

/// The factor on alpha that lets a share `wanted` of the texels reach one half.
float coverageScale(const Image& image, double wanted) {
  std::vector<float> alphas;
  alphas.reserve(image.texels.size());
  for (const vec4& texel : image.texels) alphas.push_back(texel.a);
  const auto pass = static_cast<std::size_t>(std::lround(wanted * static_cast<double>(alphas.size())));
  if (pass == 0 || pass >= alphas.size()) return 1;
  std::nth_element(alphas.begin(), alphas.begin() + static_cast<std::ptrdiff_t>(pass - 1), alphas.end(),
                   std::greater<>());
  const float threshold = alphas[pass - 1];
  return threshold > 1e-3f ? std::clamp(0.5f / threshold, 0.5f, 4.f) : 1.f;
}

float decidedShare(const Image& image) {
  double sum = 0, squares = 0;
  for (const vec4& texel : image.texels) {
    sum += static_cast<double>(texel.a);
    squares += static_cast<double>(texel.a * texel.a);
  }
  return sum > 0 ? static_cast<float>(squares / sum) : 1.f;
}

MipLevel encoded(const Image& image, float alphaScale) {
  MipLevel level{image.width, image.height, {}, decidedShare(image)};
  level.rgba.reserve(image.texels.size() * 4);
  for (const vec4& texel : image.texels) {
    // Colour keeps its ratio to alpha, or edges would change their colour with the distance.
    const float alpha = std::min(1.f, texel.a * alphaScale);
    const float scale = texel.a > 0 ? alpha / texel.a : 0.f;
    for (int c = 0; c < 3; ++c) level.rgba.push_back(byteOfLinear(texel[c] * scale));
    level.rgba.push_back(static_cast<std::uint8_t>(std::lround(alpha * 255)));
  }
  return level;
}

}  // namespace

double coverage(const MipLevel& level) {
  std::size_t pass = 0;
  for (std::size_t i = 3; i < level.rgba.size(); i += 4) pass += level.rgba[i] >= 128 ? 1 : 0;
  return level.rgba.empty() ? 0 : static_cast<double>(pass) * 4 / static_cast<double>(level.rgba.size());
}

std::vector<MipLevel> mipChain(const Picture& picture, int width, int height, bool keepCoverage) {
  Image image = resampled(linear(picture), width, height);
  std::vector<MipLevel> levels{encoded(image, 1)};
  const double wanted = coverage(levels.front());
  while (image.width > 1 || image.height > 1) {
    image = halved(image);
    // Of a handful of texels a limit makes no shape: there the mean alpha is the share that is covered.
    const bool shaped = std::min(image.width, image.height) >= kLeastShape;
    levels.push_back(encoded(image, keepCoverage && shaped ? coverageScale(image, wanted) : 1.f));
  }
  return levels;
}

}  // namespace windfall::render
