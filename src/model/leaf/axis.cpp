#include "model/leaf/axis.h"

#include <QLineF>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/image_cv_private.h"
#include "model/leaf/margin_depth_private.h"

namespace windfall::model {

namespace {

constexpr int kWorkSide = 512;        // px
constexpr double kLeastStalk = 0.05;  // teeth and drip tips score 0.02 to 0.045, short stubs of petioles 0.06
constexpr double kRound = 1.25;       // length over width below which a blade has no long axis

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

/// A part that an opening with a disc of `radius` took away, judged as a petiole; score 0 where it is none.
Stalk judge(const cv::Mat1i& labels, int label, const cv::Rect& part, const cv::Mat1b& nearBlade, double size) {
  std::vector<cv::Point> pixels;
  cv::Point2d base(0, 0);
  int joined = 0;
  for (int y = part.y; y < part.br().y; ++y) {
    for (int x = part.x; x < part.br().x; ++x) {
      if (labels(y, x) != label) continue;
      pixels.emplace_back(x, y);
      if (nearBlade(y, x)) {
        base += cv::Point2d(x, y);
        ++joined;
      }
    }
  }
  if (joined == 0) return {};
  base /= static_cast<double>(joined);
  double length = 0;
  for (const cv::Point& p : pixels) length = std::max(length, cv::norm(cv::Point2d(p) - base));
  const double width = static_cast<double>(pixels.size()) / std::max(1.0, length);
  if (length < 0.03 * size || length < 1.8 * width) return {};
  // A tooth or a lobe's tip tapers: its outer third holds a ninth of it. A petiole keeps its width.
  double inner = 0, outer = 0;
  for (const cv::Point& p : pixels) {
    const double t = cv::norm(cv::Point2d(p) - base) / length;
    inner += t < 1.0 / 3;
    outer += t > 2.0 / 3;
  }
  const double evenness = std::min(1.0, outer / std::max(inner, 1.0));
  if (evenness < 0.5) return {};
  Stalk stalk{labels == label, base, middleLine(pixels, base, length), 0};
  const double thinness = std::clamp(0.03 * size / width, 0.15, 1.0);
  stalk.score = std::sqrt(length / size) * evenness * std::min(1.0, length / (5 * width)) * thinness;
  return stalk;
}

/// Length of the run of leaf pixels through a place, across a direction.
double widthAcross(const cv::Mat1b& mask, cv::Point2d at, cv::Point2d along) {
  const cv::Point2d across(-along.y, along.x);
  double width = 1;
  for (const double side : {-1.0, 1.0}) {
    for (int t = 1; t < mask.cols + mask.rows; ++t) {
      const cv::Point p(at + side * t * across);
      if (p.x < 0 || p.y < 0 || p.x >= mask.cols || p.y >= mask.rows || !mask(p)) break;
      width += 1;
    }
  }
  return width;
}

std::optional<Stalk> findStalk(const cv::Mat1b& mask) {
  const double size = std::max(mask.cols, mask.rows);
  const cv::Moments m = cv::moments(mask, true);
  const cv::Point2d centre(m.m10 / m.m00, m.m01 / m.m00);
  const double inner = innerRadius(marginDepth(mask, cv::DIST_MASK_5));
  // In petiole widths from the joint: there a blade is seen to be wider, a narrow one later.
  const double behind = inner < 0.08 * size ? 5 : 2;
  std::optional<Stalk> best;
  // The smallest disc that takes the petiole leaves its joint where the blade begins; a stout petiole needs a larger
  // one.
  struct Disc {
    double share;   ///< of the leaf's size
    double narrow;  ///< of the inner radius at most: a narrow blade must outlast it
  };
  for (const auto& [share, narrow] : {Disc{0.013, 0.2}, Disc{0.022, 0.3}, Disc{0.04, 0.45}}) {
    const int radius = std::max(2, static_cast<int>(std::lround(std::min(share * size, narrow * inner))));
    const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
    cv::Mat1b near, padded;
    cv::copyMakeBorder(mask, padded, radius, radius, radius, radius, cv::BORDER_CONSTANT, 0);
    cv::morphologyEx(padded, padded, cv::MORPH_OPEN, disc);
    const cv::Mat1b blade = padded(cv::Rect(radius, radius, mask.cols, mask.rows)).clone();
    cv::dilate(blade, near, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
    const cv::Mat1b thin = mask & ~blade;
    cv::Mat1i labels, stats;
    cv::Mat1d centres;
    const int count = cv::connectedComponentsWithStats(thin, labels, stats, centres, 8);
    for (int i = 1; i < count; ++i) {
      if (stats(i, cv::CC_STAT_AREA) < 12) continue;
      const cv::Rect part(stats(i, cv::CC_STAT_LEFT), stats(i, cv::CC_STAT_TOP), stats(i, cv::CC_STAT_WIDTH),
                          stats(i, cv::CC_STAT_HEIGHT));
      Stalk stalk = judge(labels, i, part, near, size);
      if (stalk.score <= 0) continue;
      // A petiole points away from the middle, and most photos have it below.
      const cv::Point2d out = stalk.base - centre;
      const cv::Point2d way = point(stalk.line.front()) - stalk.base;
      const double outward = out.dot(way) / std::max(1e-9, cv::norm(out) * cv::norm(way));
      // A petiole ends abruptly at the blade, the tip of a blade widens by and by.
      const double width = cv::countNonZero(stalk.pixels) / std::max(1.0, cv::norm(way));
      const cv::Point2d inward = way * (-1 / std::max(1e-9, cv::norm(way)));
      const double widening = widthAcross(mask, stalk.base + behind * width * inward, inward) / width;
      stalk.score *= std::clamp((widening - 1.3) / 2.5, 0.15, 1.0);
      stalk.score *= std::clamp(0.6 + 0.5 * outward, 0.2, 1.0) * (out.y > 0 ? 1.0 : 0.75);

      if (stalk.score < kLeastStalk) continue;
      // Larger discs must find something clearly better: they also take lobes.
      if (!best || stalk.score > 1.25 * best->score) best = std::move(stalk);
    }
  }
  return best;
}

/// The base of a blade without petiole: the blunter end of a long blade; of a round one the border point that is low
/// and near the middle (the thesis's score, rows counting downwards).
QPointF baseWithoutStalk(const cv::Mat1b& mask, const Polygon& border) {
  const cv::Moments m = cv::moments(mask, true);
  const cv::Point2d centre(m.m10 / m.m00, m.m01 / m.m00);
  const double half = (m.mu20 + m.mu02) / 2;
  const double difference = std::hypot((m.mu20 - m.mu02) / 2, m.mu11);
  const double elongation = std::sqrt((half + difference) / std::max(1e-9, half - difference));
  if (elongation < kRound) {
    double lowest = 0;
    for (const QPointF& p : border) lowest = std::max(lowest, p.y());
    std::vector<double> xs;
    for (const QPointF& p : border) xs.push_back(p.x());
    std::nth_element(xs.begin(), xs.begin() + static_cast<std::ptrdiff_t>(xs.size() / 2), xs.end());
    const double median = xs[xs.size() / 2];
    const auto score = [&](const QPointF& p) { return std::abs(p.x() - median) + lowest - p.y(); };
    return *std::min_element(border.begin(), border.end(),
                             [&](const QPointF& a, const QPointF& b) { return score(a) < score(b); });
  }
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
  return spread(true) >= spread(false) ? lowEnd : highEnd;
}

}  // namespace

LeafAxis findAxis(const QImage& maskImage, const Polygon& border, std::optional<QPointF> givenRoot) {
  const cv::Mat1b full = grayView(maskImage);
  QRectF bounds;
  for (const QPointF& p : border) bounds |= QRectF(p, QSizeF(1, 1));
  const cv::Rect box = cv::Rect(static_cast<int>(bounds.x()), static_cast<int>(bounds.y()),
                                static_cast<int>(bounds.width()), static_cast<int>(bounds.height())) &
                       cv::Rect(0, 0, full.cols, full.rows);
  // Every leaf is looked at in the same size, however small it lies in its photo. Other components are not its.
  std::vector<cv::Point> outline;
  for (const QPointF& p : border) outline.emplace_back(static_cast<int>(p.x()), static_cast<int>(p.y()));
  cv::Mat1b own(box.size(), static_cast<uchar>(0));
  cv::drawContours(own, std::vector<std::vector<cv::Point>>{outline}, 0, 255, cv::FILLED, cv::LINE_8, cv::noArray(), 0,
                   -box.tl());
  const double scale = static_cast<double>(kWorkSide) / std::max(box.width, box.height);
  const QPointF corner(box.x, box.y);
  cv::Mat1b mask;
  cv::resize(own, mask, {}, scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
  mask = mask > 127;
  const std::optional<Stalk> stalk = findStalk(mask);
  LeafAxis axis;
  if (stalk) {
    for (const QPointF& p : stalk->line) axis.petiole.push_back(corner + p / scale);
  }
  if (givenRoot) {
    axis.root = *givenRoot;
    // A petiole that joins the blade elsewhere is not this leaf's.
    const double reach = 0.08 * std::max(full.cols, full.rows);
    if (stalk && QLineF(axis.petiole.back(), axis.root).length() > reach) axis.petiole.clear();
  } else if (stalk) {
    axis.root = axis.petiole.back();
  } else {
    axis.root = baseWithoutStalk(full, border);
  }
  double farthest = -1;
  for (const QPointF& p : border) {
    const int x = std::min(mask.cols - 1, static_cast<int>((p.x() - corner.x()) * scale));
    const int y = std::min(mask.rows - 1, static_cast<int>((p.y() - corner.y()) * scale));
    if (!axis.petiole.empty() && stalk->pixels(y, x)) continue;
    const double distance = QLineF(p, axis.root).length();
    if (distance > farthest) farthest = distance, axis.tip = p;
  }
  return axis;
}

}  // namespace windfall::model
