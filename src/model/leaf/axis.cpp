#include "model/leaf/axis.h"

#include <QLineF>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/image_cv_private.h"

namespace windfall::model {

namespace {

constexpr int kWorkSide = 512;

cv::Point2d point(QPointF p) { return {p.x(), p.y()}; }
QPointF point(cv::Point2d p) { return {p.x, p.y}; }

/// A candidate for the petiole: a thin part that the opening removed.
struct Stalk {
  cv::Mat1b pixels;
  cv::Point2d base;  ///< where it joins the blade
  Polygon line;      ///< free end to base
  double score = 0;
};

/// Centres of slices at growing distance from the base: the stalk's middle line.
Polygon middleLine(const std::vector<cv::Point>& pixels, cv::Point2d base, double length) {
  const int slices = std::clamp(static_cast<int>(length / 4), 2, 60);
  std::vector<cv::Point2d> sum(static_cast<size_t>(slices));
  std::vector<int> count(static_cast<size_t>(slices), 0);
  for (const cv::Point& p : pixels) {
    const double distance = cv::norm(cv::Point2d(p) - base);
    const auto slice = static_cast<size_t>(std::min(slices - 1, static_cast<int>(distance / length * slices)));
    sum[slice] += cv::Point2d(p);
    ++count[slice];
  }
  Polygon line;
  for (size_t i = sum.size(); i-- > 0;) {
    if (count[i] > 0) line.push_back(point(sum[i] / count[i]));
  }
  line.push_back(point(base));
  return line;
}

std::optional<Stalk> findStalk(const cv::Mat1b& mask) {
  const cv::Rect box = cv::boundingRect(mask);
  const double size = std::max(box.width, box.height);
  const int radius = std::max(2, static_cast<int>(std::lround(0.04 * size)));
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
  cv::Mat1b blade, near;
  cv::Mat1b padded;
  cv::copyMakeBorder(mask, padded, radius, radius, radius, radius, cv::BORDER_CONSTANT, 0);
  cv::morphologyEx(padded, padded, cv::MORPH_OPEN, disc);
  blade = padded(cv::Rect(radius, radius, mask.cols, mask.rows)).clone();
  cv::dilate(blade, near, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  const cv::Mat1b thin = mask & ~blade;
  cv::Mat1i labels, stats;
  cv::Mat1d centres;
  const int count = cv::connectedComponentsWithStats(thin, labels, stats, centres, 8);
  std::optional<Stalk> best;
  for (int i = 1; i < count; ++i) {
    if (stats(i, cv::CC_STAT_AREA) < 12) continue;
    std::vector<cv::Point> pixels;
    cv::Point2d base(0, 0);
    int joined = 0;
    const cv::Rect part(stats(i, cv::CC_STAT_LEFT), stats(i, cv::CC_STAT_TOP), stats(i, cv::CC_STAT_WIDTH),
                        stats(i, cv::CC_STAT_HEIGHT));
    for (int y = part.y; y < part.br().y; ++y) {
      for (int x = part.x; x < part.br().x; ++x) {
        if (labels(y, x) != i) continue;
        pixels.emplace_back(x, y);
        if (near(y, x)) {
          base += cv::Point2d(x, y);
          ++joined;
        }
      }
    }
    if (joined == 0) continue;
    base /= static_cast<double>(joined);
    double length = 0;
    for (const cv::Point& p : pixels) length = std::max(length, cv::norm(cv::Point2d(p) - base));
    if (length < 0.05 * size) continue;
    // A tooth or a lobe's tip tapers: its outer third holds a ninth of it. A petiole keeps its width.
    double inner = 0, outer = 0;
    for (const cv::Point& p : pixels) {
      const double t = cv::norm(cv::Point2d(p) - base) / length;
      inner += t < 1.0 / 3;
      outer += t > 2.0 / 3;
    }
    const double width = static_cast<double>(pixels.size()) / length;
    const double evenness = std::min(1.0, outer / std::max(inner, 1.0));
    if (length < 2 * width || evenness < 0.55) continue;
    const double score = length / size * evenness * std::min(1.0, length / (5 * width));
    if (!best || score > best->score) best = Stalk{labels == i, base, middleLine(pixels, base, length), score};
  }
  return best;
}

/// Ends of the long axis; the blunter one first.
std::pair<QPointF, QPointF> longAxisEnds(const cv::Mat1b& mask, const Polygon& border) {
  const cv::Moments m = cv::moments(mask, true);
  const cv::Point2d centre(m.m10 / m.m00, m.m01 / m.m00);
  const double angle = 0.5 * std::atan2(2 * m.mu11, m.mu20 - m.mu02);
  const cv::Point2d along(std::cos(angle), std::sin(angle));
  double low = 1e9, high = -1e9;
  QPointF lowEnd, highEnd;
  for (const QPointF& p : border) {
    const double t = (point(p) - centre).dot(along);
    if (t < low) low = t, lowEnd = p;
    if (t > high) high = t, highEnd = p;
  }
  // How many border points lie in the outer tenth: the blunt end has its border spread farther across.
  const cv::Point2d across(-along.y, along.x);
  const auto spread = [&](bool atLow) {
    double least = 1e9, most = -1e9;
    for (const QPointF& p : border) {
      const double t = ((point(p) - centre).dot(along) - low) / (high - low);
      if (atLow ? t > 0.12 : t < 0.88) continue;
      const double s = (point(p) - centre).dot(across);
      least = std::min(least, s);
      most = std::max(most, s);
    }
    return most - least;
  };
  return spread(true) >= spread(false) ? std::pair(lowEnd, highEnd) : std::pair(highEnd, lowEnd);
}

}  // namespace

LeafAxis findAxis(const QImage& maskImage, const Polygon& border, std::optional<QPointF> givenRoot) {
  const cv::Mat1b full = grayView(maskImage);
  const double scale = std::min(1.0, static_cast<double>(kWorkSide) / std::max(full.cols, full.rows));
  cv::Mat1b mask;
  cv::resize(full, mask, {}, scale, scale, cv::INTER_AREA);
  mask = mask > 127;
  const std::optional<Stalk> stalk = findStalk(mask);
  LeafAxis axis;
  if (stalk) {
    for (const QPointF& p : stalk->line) axis.petiole.push_back(p / scale);
  }
  if (givenRoot) {
    axis.root = *givenRoot;
    // A petiole that joins the blade elsewhere is not this leaf's.
    const double reach = 0.08 * std::max(full.cols, full.rows);
    if (stalk && QLineF(axis.petiole.back(), axis.root).length() > reach) axis.petiole.clear();
  } else if (stalk) {
    axis.root = axis.petiole.back();
  } else {
    axis.root = longAxisEnds(full, border).first;
  }
  double farthest = -1;
  for (const QPointF& p : border) {
    const int x = std::min(mask.cols - 1, static_cast<int>(p.x() * scale));
    const int y = std::min(mask.rows - 1, static_cast<int>(p.y() * scale));
    if (!axis.petiole.empty() && stalk->pixels(y, x)) continue;
    const double distance = QLineF(p, axis.root).length();
    if (distance > farthest) farthest = distance, axis.tip = p;
  }
  return axis;
}

}  // namespace windfall::model
