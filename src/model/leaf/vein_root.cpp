#include "model/leaf/vein_root.h"

#include <QLineF>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <queue>

#include "model/leaf/image_cv_private.h"
#include "model/leaf/margin_depth_private.h"
#include "model/leaf/vein_ridges_private.h"

namespace windfall::model {

namespace {

constexpr int kWorkSide = 400;
constexpr int kDirections = 12;          // of half a turn
constexpr float kLeastContrast = 0.35f;  // lightness: below it a blade shows no veins
constexpr double kReach = 0.22;          // of the leaf's size: how far the guess may be wrong
constexpr double kNarrowReach = 2.2;     // of the blade's inner radius: along a narrow one not so far

/// Where lines along the ridges meet from many directions; no place where they do not.
std::optional<cv::Point> meetingPlace(const VeinRidges& ridges, const cv::Mat1b& leaf) {
  const int cell = 4, columns = leaf.cols / cell + 1, rows = leaf.rows / cell + 1;
  // Both ways of each direction count apart: a midrib passes a place, veins that begin there do not.
  std::vector<std::array<float, 2 * kDirections>> votes(static_cast<size_t>(columns) * static_cast<size_t>(rows));
  const double far = 0.45 * std::max(leaf.cols, leaf.rows);
  for (int y = 0; y < leaf.rows; y += 1) {
    for (int x = 0; x < leaf.cols; x += 1) {
      const float strength = std::min(1.f, ridges.strength(y, x));
      if (strength < 0.3f) continue;
      for (const double way : {0.0, std::numbers::pi}) {
        const double angle = ridges.angle(y, x) + way;
        const double dx = std::cos(angle), dy = std::sin(angle);
        const double turn = angle / (2 * std::numbers::pi) + 4;
        const auto direction = static_cast<size_t>((turn - std::floor(turn)) * 2 * kDirections) % (2 * kDirections);
        for (double t = 3; t < far; t += cell) {
          const int px = static_cast<int>(x + t * dx), py = static_cast<int>(y + t * dy);
          if (px < 0 || py < 0 || px >= leaf.cols || py >= leaf.rows || !leaf(py, px)) break;
          votes[static_cast<size_t>(py / cell) * static_cast<size_t>(columns) + static_cast<size_t>(px / cell)]
               [direction] += strength / static_cast<float>(20 + t);
        }
      }
    }
  }
  cv::Mat1f score(rows, columns, 0.f);
  cv::Mat1i many(rows, columns, 0);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      auto from = votes[static_cast<size_t>(y) * static_cast<size_t>(columns) + static_cast<size_t>(x)];
      float sum = 0;
      for (const float v : from) sum += std::sqrt(v);
      score(y, x) = sum * sum;
      const float most = *std::max_element(from.begin(), from.end());
      many(y, x) =
          static_cast<int>(std::count_if(from.begin(), from.end(), [most](float v) { return v > 0.3f * most; }));
    }
  }
  cv::GaussianBlur(score, score, {}, 1.2);
  double best = 0;
  cv::Point place;
  cv::minMaxLoc(score, nullptr, &best, nullptr, &place);
  if (best <= 0) return {};
  // A meeting place stands out: along a midrib with laterals many places are alike.
  double second = 0;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const bool apart = std::hypot(x - place.x, y - place.y) * cell > 0.14 * std::max(leaf.cols, leaf.rows);
      if (apart) second = std::max(second, static_cast<double>(score(y, x)));
    }
  }
  int sides = 0;
  for (int y = std::max(0, place.y - 1); y <= std::min(rows - 1, place.y + 1); ++y) {
    for (int x = std::max(0, place.x - 1); x <= std::min(columns - 1, place.x + 1); ++x) {
      sides = std::max(sides, many(y, x));
    }
  }
  if (best < 1.6 * second || sides < 6) return {};
  return cv::Point(place.x * cell + cell / 2, place.y * cell + cell / 2);
}

/// Cost of the cheapest way along ridges from the tip.
cv::Mat1f waysFrom(cv::Point tip, const cv::Mat1f& ridge, const cv::Mat1b& leaf) {
  cv::Mat1f reached(leaf.size(), 1e30f);
  using Item = std::pair<float, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  reached(tip) = 0;
  queue.emplace(0.f, tip.y * leaf.cols + tip.x);
  while (!queue.empty()) {
    const auto [distance, index] = queue.top();
    queue.pop();
    const cv::Point here(index % leaf.cols, index / leaf.cols);
    if (distance > reached(here)) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const cv::Point next = here + cv::Point(dx, dy);
        if (next.x < 0 || next.y < 0 || next.x >= leaf.cols || next.y >= leaf.rows || !leaf(next)) continue;
        const float step = (dx != 0 && dy != 0 ? 1.4142f : 1.f) / (0.06f + std::min(1.f, ridge(next)));
        if (distance + step >= reached(next)) continue;
        reached(next) = distance + step;
        queue.emplace(distance + step, next.y * leaf.cols + next.x);
      }
    }
  }
  return reached;
}

}  // namespace

LeafAxis rootByVeins(const QImage& photo, const QImage& mask, const Polygon& border, const LeafAxis& axis) {
  const cv::Rect box = cv::boundingRect(grayView(mask));
  if (box.empty() || border.size() < 8) return axis;
  const double scale = std::min(1.0, static_cast<double>(kWorkSide) / std::max(box.width, box.height));
  const QImage part = photo.copy(QRect(box.x, box.y, box.width, box.height));
  cv::Mat3f lab;
  cv::resize(toLab(part), lab, {}, scale, scale, cv::INTER_AREA);
  cv::Mat1b leaf;
  cv::resize(grayView(mask)(box), leaf, lab.size(), 0, 0, cv::INTER_AREA);
  leaf = leaf > 127;
  const VeinRidges ridges = veinRidges(lab, leaf);
  if (ridges.contrast < kLeastContrast) return axis;
  const QPointF corner(box.x, box.y);
  const auto toWork = [&](QPointF p) {
    const QPointF w = (p - corner) * scale;
    return cv::Point(std::clamp(static_cast<int>(w.x()), 0, leaf.cols - 1),
                     std::clamp(static_cast<int>(w.y()), 0, leaf.rows - 1));
  };
  LeafAxis result = axis;
  if (const std::optional<cv::Point> place = meetingPlace(ridges, leaf)) {
    result.root = corner + QPointF(place->x, place->y) / scale;
    result.tip = *std::max_element(border.begin(), border.end(), [&](const QPointF& a, const QPointF& b) {
      return QLineF(a, result.root).length() < QLineF(b, result.root).length();
    });
    return result;
  }
  cv::Mat1b wide;
  cv::dilate(leaf, wide, cv::Mat());
  const cv::Mat1f ways = waysFrom(toWork(axis.tip), ridges.strength, wide);
  const double inner = innerRadius(marginDepth(leaf, cv::DIST_MASK_3));
  const double reach = std::min(kReach * std::max(box.width, box.height), kNarrowReach * inner / scale);
  float least = 1e29f;
  for (const QPointF& p : border) {
    if (QLineF(p, axis.root).length() > reach) continue;
    const float way = ways(toWork(p));
    if (way < least) least = way, result.root = p;
  }
  return result;
}

}  // namespace windfall::model
