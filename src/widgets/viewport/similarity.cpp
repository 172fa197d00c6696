#include "widgets/viewport/similarity.h"

#include <vector>

namespace windfall::widgets {

namespace {

constexpr int kWindow = 8, kStep = 4;
constexpr float kBehind = 212;  // brightness of a clear sky

std::vector<float> brightness(const render::Picture& picture) {
  std::vector<float> out(picture.rgba.size() / 4);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::uint8_t* p = &picture.rgba[4 * i];
    const float sum =
        0.299f * static_cast<float>(p[0]) + 0.587f * static_cast<float>(p[1]) + 0.114f * static_cast<float>(p[2]);
    const float alpha = static_cast<float>(p[3]) / 255;
    out[i] = sum + kBehind * (1 - alpha);
  }
  return out;
}

}  // namespace

double similarity(const render::Picture& a, const render::Picture& b) {
  if (a.width != b.width || a.height != b.height || a.width < kWindow || a.height < kWindow) return 0;
  const std::vector<float> first = brightness(a), second = brightness(b);
  const double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255, n = kWindow * kWindow;
  double total = 0;
  std::size_t windows = 0;
  for (int y = 0; y + kWindow <= a.height; y += kStep) {
    for (int x = 0; x + kWindow <= a.width; x += kStep, ++windows) {
      double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
      for (int dy = 0; dy < kWindow; ++dy) {
        const std::size_t row = static_cast<std::size_t>(y + dy) * static_cast<std::size_t>(a.width);
        for (int dx = 0; dx < kWindow; ++dx) {
          const std::size_t i = row + static_cast<std::size_t>(x + dx);
          const double va = first[i], vb = second[i];
          sa += va, sb += vb, saa += va * va, sbb += vb * vb, sab += va * vb;
        }
      }
      const double ma = sa / n, mb = sb / n;
      const double variance = saa / n - ma * ma + sbb / n - mb * mb, covariance = sab / n - ma * mb;
      total += (2 * ma * mb + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (variance + c2));
    }
  }
  return windows > 0 ? total / static_cast<double>(windows) : 0;
}

}  // namespace windfall::widgets
