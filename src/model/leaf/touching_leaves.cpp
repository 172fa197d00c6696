#include "model/leaf/touching_leaves_private.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace windfall::model {

namespace {

constexpr double kWorkSide = 512;
/// Of the lesser part's inner radius: a wider neck may be a waist of one leaf.
constexpr float kWidestNeck = 0.5f;
/// Of the largest inner radius in the mask: lesser parts are lobes or crumbs.
constexpr float kLeastPart = 0.35f;
constexpr double kLeastSolidity = 0.86;
constexpr double kLeastNearSolidity = 0.93;
constexpr double kLeastAngle = 35;     // degrees between a part's axis and the way to its neck, that is no end of it
constexpr double kRoundAspect = 1.25;  // below it a part has no axis
constexpr double kMostOverlap = 0.06;  // of the hulls of two leaves
constexpr double kStalkShare = 0.15;   // of the lesser inner radius: what is shorter is an unevenness of the margin

/// A place where two parts meet.
struct Neck {
  cv::Point2f middle, from, to;  ///< on the ground at both sides
  float halfWidth = 0;
  float radius = 0;  ///< inner radius of the lesser part
};

/// Parts by their inner radius, and where they meet: the tree of the distance's superlevel sets.
class Parts {
 public:
  explicit Parts(const cv::Mat1f& depth) : depth_(depth), parent_(depth.total(), -1), peak_(depth.total(), 0) {
    double deepest = 0;
    cv::minMaxLoc(depth, nullptr, &deepest);
    least_ = kLeastPart * static_cast<float>(deepest);
    std::vector<int> order;
    for (int i = 0; i < static_cast<int>(depth.total()); ++i) {
      if (at(i) > 0) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return at(a) > at(b); });
    for (const int i : order) add(i);
  }

  /// Saddle places, each with the lesser inner radius beside it.
  const std::vector<std::pair<cv::Point, float>>& saddles() const { return saddles_; }

 private:
  float at(int i) const { return depth_(i / depth_.cols, i % depth_.cols); }

  int rootOf(int i) {
    while (parent_[static_cast<size_t>(i)] != i) {
      parent_[static_cast<size_t>(i)] = parent_[static_cast<size_t>(parent_[static_cast<size_t>(i)])];
      i = parent_[static_cast<size_t>(i)];
    }
    return i;
  }

  void add(int i) {
    parent_[static_cast<size_t>(i)] = i;
    peak_[static_cast<size_t>(i)] = at(i);
    const int x = i % depth_.cols, y = i / depth_.cols;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int nx = x + dx, ny = y + dy;
        if (nx < 0 || ny < 0 || nx >= depth_.cols || ny >= depth_.rows) continue;
        const int other = ny * depth_.cols + nx;
        if (parent_[static_cast<size_t>(other)] < 0) continue;
        int a = rootOf(i), b = rootOf(other);
        if (a == b) continue;
        if (peak_[static_cast<size_t>(a)] < peak_[static_cast<size_t>(b)]) std::swap(a, b);
        const float lesser = peak_[static_cast<size_t>(b)];
        if (lesser >= least_ && at(i) <= kWidestNeck * lesser) saddles_.emplace_back(cv::Point(x, y), lesser);
        parent_[static_cast<size_t>(b)] = a;
      }
    }
  }

  const cv::Mat1f& depth_;
  std::vector<int> parent_;
  std::vector<float> peak_;
  float least_ = 0;
  std::vector<std::pair<cv::Point, float>> saddles_;
};

/// The ground nearest to a place, in all directions or in those against `side`.
std::optional<cv::Point> nearestGround(const cv::Mat1b& mask, cv::Point place, float reach, cv::Point2f side) {
  const int r = static_cast<int>(std::ceil(reach));
  std::optional<cv::Point> best;
  float least = reach * reach;
  for (int y = std::max(0, place.y - r); y <= std::min(mask.rows - 1, place.y + r); ++y) {
    for (int x = std::max(0, place.x - r); x <= std::min(mask.cols - 1, place.x + r); ++x) {
      const cv::Point2f way(static_cast<float>(x - place.x), static_cast<float>(y - place.y));
      const float length = way.dot(way);
      if (mask(y, x) || length > least || way.dot(side) > -0.5f * cv::norm(side) * std::sqrt(length)) continue;
      if (length < least || !best) least = length, best = cv::Point(x, y);
    }
  }
  return best;
}

std::vector<Neck> necksOf(const cv::Mat1b& mask, const cv::Mat1f& depth) {
  std::vector<Neck> necks;
  const Parts parts(depth);
  for (const auto& [place, radius] : parts.saddles()) {
    const float half = depth(place);
    const auto from = nearestGround(mask, place, half + 2, {});
    if (!from) continue;
    const auto to = nearestGround(mask, place, 2 * half + 3, cv::Point2f(*from - place));
    if (!to) continue;
    const cv::Point2f a(*from), b(*to);
    necks.push_back({0.5f * (a + b), a, b, 0.5f * static_cast<float>(cv::norm(a - b)), radius});
  }
  return necks;
}

/// Takes the mask apart along a neck; `width` px.
void cut(cv::Mat1b& mask, cv::Point2f from, cv::Point2f to, int width) {
  const cv::Point2f along = to - from,
                    more = along * (static_cast<float>(width) / std::max(1.f, static_cast<float>(cv::norm(along))));
  cv::line(mask, cv::Point(from - more), cv::Point(to + more), 0, width);
}

struct Shape {
  cv::Mat1b mask;
  double area = 0, aspect = 1, solidity = 0;
  float radius = 0;  ///< inner
  cv::Point2f centre, axis;
  std::vector<cv::Point> hull;
};

/// A part without its petiole.
Shape shapeOf(const cv::Mat1b& part) {
  Shape shape;
  cv::Mat1f depth;
  cv::distanceTransform(part, depth, cv::DIST_L2, 5);
  double deepest = 0;
  cv::minMaxLoc(depth, nullptr, &deepest);
  shape.radius = static_cast<float>(deepest);
  const int reach = std::max(1, static_cast<int>(0.2 * deepest));
  cv::morphologyEx(part, shape.mask, cv::MORPH_OPEN,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1}));
  const cv::Moments m = cv::moments(shape.mask, true);
  if (m.m00 < 16) return shape;
  shape.area = m.m00;
  shape.centre = {static_cast<float>(m.m10 / m.m00), static_cast<float>(m.m01 / m.m00)};
  const double spread = std::hypot(m.mu20 - m.mu02, 2 * m.mu11), both = m.mu20 + m.mu02;
  const double angle = 0.5 * std::atan2(2 * m.mu11, m.mu20 - m.mu02);
  shape.axis = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
  shape.aspect = std::sqrt((both + spread) / std::max(1e-9, both - spread));
  std::vector<cv::Point> places;
  cv::findNonZero(shape.mask, places);
  cv::convexHull(places, shape.hull);
  shape.solidity = shape.area / std::max(shape.area, cv::contourArea(shape.hull));
  return shape;
}

/// The two connected parts beside a cut, -1 for ground.
std::pair<int, int> beside(const cv::Mat1i& labels, const Neck& neck) {
  const cv::Point2f along = neck.to - neck.from;
  const cv::Point2f across = cv::Point2f(-along.y, along.x) / std::max(1.f, static_cast<float>(cv::norm(along)));
  const auto labelAt = [&](float sign) {
    for (float step = 1; step < 8; ++step) {
      const cv::Point p(neck.middle + across * (sign * step));
      if (p.x < 0 || p.y < 0 || p.x >= labels.cols || p.y >= labels.rows) break;
      if (labels(p) > 0) return labels(p);
    }
    return -1;
  };
  return {labelAt(1), labelAt(-1)};
}

/// Whether a part widens at once behind its neck; a stalk, and a long thin tip, do not.
bool widens(const cv::Mat1f& depth, const cv::Mat1i& labels, int label, const Neck& neck, const Shape& shape) {
  const float reach = 0.6f * shape.radius + neck.halfWidth, wanted = neck.halfWidth + 0.25f * shape.radius;
  const int r = static_cast<int>(reach);
  for (int y = -r; y <= r; ++y) {
    for (int x = -r; x <= r; ++x) {
      const cv::Point p(static_cast<int>(neck.middle.x) + x, static_cast<int>(neck.middle.y) + y);
      if (x * x + y * y > r * r || p.x < 0 || p.y < 0 || p.x >= labels.cols || p.y >= labels.rows) continue;
      if (labels(p) == label && depth(p) >= wanted) return true;
    }
  }
  return false;
}

/// Whether a part's margin curves away from its neck at both sides, as two leaves that touch do; towards a waist that
/// was eaten or grown it curves in.
bool curvesAway(const cv::Mat1i& labels, int label, const Neck& neck, const Shape& shape) {
  const int r = static_cast<int>(std::lround(neck.halfWidth + 0.8f * shape.radius));
  const cv::Point middle(neck.middle);
  const cv::Rect around = cv::Rect(middle.x - r, middle.y - r, 2 * r + 1, 2 * r + 1) & cv::Rect({}, labels.size());
  const cv::Mat1b disc = cv::Mat1b::zeros(around.size());
  cv::circle(disc, middle - around.tl(), r, 255, cv::FILLED);
  const cv::Mat1b part = (labels(around) == label) & disc;
  std::vector<cv::Point> places, hull;
  cv::findNonZero(part, places);
  if (places.size() < 8) return false;
  cv::convexHull(places, hull);
  return static_cast<double>(places.size()) >= kLeastNearSolidity * cv::contourArea(hull);
}

/// Whether the neck lies at an end of the part's axis, where leaflets and lobes have theirs.
bool atItsEnd(const Neck& neck, const Shape& shape) {
  if (shape.aspect < kRoundAspect) return false;
  const cv::Point2f way = neck.middle - shape.centre;
  const double cosine = std::abs(way.dot(shape.axis)) / std::max(1e-6, cv::norm(way));
  return cosine > std::cos(kLeastAngle * CV_PI / 180);
}

/// Whether a petiole or another part leaves from the neck too.
bool isKnot(const cv::Mat1b& mask, const Neck& neck) {
  cv::Mat1b rest = mask.clone();
  const float hidden = 1.5f * neck.halfWidth + 2;
  cv::circle(rest, cv::Point(neck.middle), static_cast<int>(std::lround(hidden)), 0, cv::FILLED);
  cv::Mat1i labels;
  const int count = cv::connectedComponents(rest, labels, 8);
  // How far each of them reaches away from the hidden disc, of those that begin at it.
  std::vector<float> nearest(static_cast<size_t>(count), 1e9f), farthest(static_cast<size_t>(count), 0);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const auto label = static_cast<size_t>(labels(y, x));
      const float way =
          static_cast<float>(cv::norm(cv::Point2f(static_cast<float>(x), static_cast<float>(y)) - neck.middle));
      nearest[label] = std::min(nearest[label], way);
      farthest[label] = std::max(farthest[label], way);
    }
  }
  int arms = 0;
  for (size_t i = 1; i < nearest.size(); ++i) {
    arms += nearest[i] < hidden + 2 && farthest[i] > hidden + kStalkShare * neck.radius;
  }
  return arms > 2;
}

/// Whether all necks are surely places where two leaves touch. `whole`: before the cuts.
bool surelyTouch(const cv::Mat1b& whole, const cv::Mat1f& depth, const std::vector<Neck>& necks) {
  cv::Mat1b apart = whole.clone();
  for (const Neck& neck : necks) cut(apart, neck.from, neck.to, 2);
  cv::Mat1i labels;
  const int count = cv::connectedComponents(apart, labels, 4);
  std::vector<std::optional<Shape>> shapes(static_cast<size_t>(count));
  const auto shape = [&](int label) -> const Shape& {
    auto& known = shapes[static_cast<size_t>(label)];
    if (!known) known = shapeOf(labels == label);
    return *known;
  };
  for (const Neck& neck : necks) {
    const auto [a, b] = beside(labels, neck);
    if (a < 0 || b < 0 || a == b) return false;
    for (const int label : {a, b}) {
      if (shape(label).solidity < kLeastSolidity) return false;
      if (!curvesAway(labels, label, neck, shape(label))) return false;
      if (!widens(depth, labels, label, neck, shape(label))) return false;
    }
    if (atItsEnd(neck, shape(a)) && atItsEnd(neck, shape(b))) return false;
    if (isKnot(whole, neck)) return false;
    std::vector<cv::Point> common;
    const double overlap = cv::intersectConvexConvex(shape(a).hull, shape(b).hull, common);
    if (overlap > kMostOverlap * std::min(shape(a).area, shape(b).area)) return false;
  }
  return true;
}

/// Where leaves touch in the mask, in its own pixels; none where that is not sure.
std::vector<Neck> contacts(const cv::Mat1b& mask) {
  const cv::Rect box = cv::boundingRect(mask);
  if (box.area() < 256) return {};
  const double scale = std::min(1.0, kWorkSide / std::max(box.width, box.height));
  cv::Mat1b work;
  cv::resize(mask(box), work, {}, scale, scale, cv::INTER_AREA);
  cv::threshold(work, work, 127, 255, cv::THRESH_BINARY);
  cv::copyMakeBorder(work, work, 2, 2, 2, 2, cv::BORDER_CONSTANT, 0);
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(work, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::drawContours(work, outlines, -1, 255, cv::FILLED);
  cv::Mat1f depth;
  cv::distanceTransform(work, depth, cv::DIST_L2, 5);
  std::vector<Neck> necks = necksOf(work, depth);
  if (necks.empty() || !surelyTouch(work, depth, necks)) return {};
  for (Neck& neck : necks) {
    for (cv::Point2f* p : {&neck.middle, &neck.from, &neck.to}) {
      *p = (*p - cv::Point2f(1.5f, 1.5f)) * static_cast<float>(1 / scale) + cv::Point2f(box.tl());
    }
    neck.halfWidth *= static_cast<float>(1 / scale);
  }
  return necks;
}

}  // namespace

std::vector<cv::Mat1b> leavesOf(const cv::Mat1b& mask, double leastShare) {
  cv::Mat1b apart = mask.clone();
  cv::Mat1i labels, stats;
  cv::Mat1d centres;
  const int before = cv::connectedComponentsWithStats(mask, labels, stats, centres, 8);
  for (int i = 1; i < before; ++i) {
    if (stats(i, cv::CC_STAT_AREA) < 256) continue;
    const int width =
        2 + static_cast<int>(std::max(stats(i, cv::CC_STAT_WIDTH), stats(i, cv::CC_STAT_HEIGHT)) / kWorkSide);
    for (const Neck& neck : contacts(labels == i)) cut(apart, neck.from, neck.to, width);
  }
  const int count = cv::connectedComponentsWithStats(apart, labels, stats, centres, 4);
  std::vector<int> order;
  double largest = 0;
  for (int i = 1; i < count; ++i) largest = std::max<double>(largest, stats(i, cv::CC_STAT_AREA));
  for (int i = 1; i < count; ++i) {
    if (stats(i, cv::CC_STAT_AREA) >= leastShare * largest) order.push_back(i);
  }
  if (order.size() < 2) return {mask};
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return stats(a, cv::CC_STAT_AREA) > stats(b, cv::CC_STAT_AREA); });
  std::vector<cv::Mat1b> leaves;
  for (const int i : order) leaves.emplace_back(labels == i);
  return leaves;
}

}  // namespace windfall::model
