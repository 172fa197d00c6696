#include <QRect>
#include <algorithm>
#include <cmath>

#include "model/leaf/atlas_layout_private.h"
#include "model/leaf/rect_packing.h"

namespace windfall::model {

namespace {

constexpr int kLeastSide = 64, kMostAutomatic = 8192;

QSize scaled(QSize size, double scale, bool turned) {
  const QSize result(std::max(1, static_cast<int>(std::floor(size.width() * scale))),
                     std::max(1, static_cast<int>(std::floor(size.height() * scale))));
  return turned ? result.transposed() : result;
}

std::optional<AtlasLayout> layOutAs(const std::vector<QSize>& sizes, const std::vector<bool>& turned,
                                    const AtlasSettings& settings, QSize whole, double most) {
  const int gap = settings.gap();
  const auto placesAt = [&](double scale) -> std::optional<std::vector<QPoint>> {
    std::vector<QSize> padded;
    for (size_t i = 0; i < sizes.size(); ++i) padded.push_back(scaled(sizes[i], scale, turned[i]) + QSize(gap, gap));
    return packRectangles(padded, whole);
  };
  // By bisection; packing is not monotone, so the best seen is kept.
  double scale = most;
  std::optional<std::vector<QPoint>> corners = placesAt(scale);
  if (!corners) {
    double low = 0, high = most;
    for (int i = 0; i < 14; ++i) {
      const double middle = (low + high) / 2;
      if (auto found = placesAt(middle)) {
        low = scale = middle;
        corners = std::move(found);
      } else {
        high = middle;
      }
    }
  }
  if (!corners) return std::nullopt;
  AtlasLayout layout{whole, scale, {}, turned};
  for (size_t i = 0; i < sizes.size(); ++i) {
    layout.places.emplace_back(corners->at(i) + QPoint(gap / 2, gap / 2), scaled(sizes[i], scale, turned[i]));
  }
  return layout;
}

std::optional<AtlasLayout> layOutIn(const std::vector<QSize>& sizes, const AtlasSettings& settings, QSize whole,
                                    double most) {
  const auto all = [&](auto rule) {
    std::vector<bool> turned;
    for (const QSize& size : sizes) turned.push_back(rule(size));
    return turned;
  };
  std::optional<AtlasLayout> best = layOutAs(sizes, all([](const QSize&) { return false; }), settings, whole, most);
  if (!settings.rotate || (best && best->scale >= most)) return best;
  const auto largest = std::max_element(sizes.begin(), sizes.end(), [](const QSize& a, const QSize& b) {
    return std::max(a.width(), a.height()) < std::max(b.width(), b.height());
  });
  // Every second one turned lets leaves of one shape lie head to foot.
  size_t number = 0;
  for (const std::vector<bool>& turned :
       {all([](const QSize& s) { return s.width() > s.height(); }),
        all([](const QSize& s) { return s.height() > s.width(); }),
        all([&](const QSize& s) { return (s.width() > s.height()) != (largest->width() > largest->height()); }),
        all([&](const QSize&) { return number++ % 2 == 1; })}) {
    std::optional<AtlasLayout> other = layOutAs(sizes, turned, settings, whole, most);
    if (other && (!best || other->scale > best->scale * 1.001)) best = std::move(other);
  }
  return best;
}

}  // namespace

std::optional<AtlasLayout> layOut(const std::vector<QSize>& sizes, const AtlasSettings& settings) {
  int longest = 1;
  for (const QSize& size : sizes) longest = std::max({longest, size.width(), size.height()});
  const double most = settings.leafPixels > 0 ? std::min(1.0, static_cast<double>(settings.leafPixels) / longest) : 1;
  if (settings.size > 0) return layOutIn(sizes, settings, {settings.size, settings.size}, most);
  std::optional<AtlasLayout> layout;
  AtlasSettings tried = settings;
  for (tried.size = kLeastSide; tried.size <= kMostAutomatic; tried.size *= 2) {
    // At a small side the gap would be cut short.
    if (tried.size < kMostAutomatic && tried.gap() < settings.gap()) continue;
    const int side = tried.size;
    for (const QSize whole : {QSize(side, side / 2), QSize(side / 2, side), QSize(side, side)}) {
      layout = layOutIn(sizes, tried, whole, most);
      if (layout && layout->scale >= most) return layout;
    }
  }
  return layout;
}

}  // namespace windfall::model
