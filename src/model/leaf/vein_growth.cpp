#include "model/leaf/vein_growth.h"

#include <QLineF>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <queue>

#include "model/leaf/image_cv_private.h"
#include "model/leaf/vein_curve.h"
#include "model/leaf/vein_micro.h"

namespace windfall::model {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kMostSteps = 400;

QPointF turned(QPointF v, double angle) {
  return {v.x() * std::cos(angle) - v.y() * std::sin(angle), v.x() * std::sin(angle) + v.y() * std::cos(angle)};
}

double length(QPointF v) { return std::hypot(v.x(), v.y()); }

/// The leaf without its holes on a grid of about 256 cells: tests whether a place is on it and finds middle ways
/// through it.
class LeafGrid {
 public:
  explicit LeafGrid(const QImage& mask) : mask_(grayView(mask).clone()) {
    // Holes are no obstacle for a vein that was there before the hole.
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(mask_, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    cv::drawContours(mask_, outlines, -1, 255, cv::FILLED);
    // The leaf, not its photo, gets the cells.
    const cv::Rect box = cv::boundingRect(mask_);
    scale_ = std::min({1.0, 256.0 / std::max({box.width, box.height, 1}), 1024.0 / std::max(mask_.cols, mask_.rows)});
    cv::Mat1b small;
    cv::resize(mask_, small, {}, scale_, scale_, cv::INTER_AREA);
    small = small > 20;
    cv::copyMakeBorder(small, small, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
    cv::distanceTransform(small, depth_, cv::DIST_L2, 3);
  }

  bool contains(QPointF p) const {
    const int x = static_cast<int>(std::lround(p.x())), y = static_cast<int>(std::lround(p.y()));
    return x >= 0 && y >= 0 && x < mask_.cols && y < mask_.rows && mask_(y, x) != 0;
  }

  /// Path of least cost that keeps away from the margin; photo pixels, about two cells apart. Empty: no way.
  Polygon middleWay(QPointF from, QPointF to) const {
    const cv::Point start = cell(from), goal = cell(to);
    cv::Mat1f cost(depth_.size(), 1e30f);
    cv::Mat1i before(depth_.size(), -1);
    using Item = std::pair<float, int>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    cost(start) = 0;
    queue.emplace(0.f, start.y * depth_.cols + start.x);
    while (!queue.empty()) {
      const auto [reached, index] = queue.top();
      queue.pop();
      const cv::Point here(index % depth_.cols, index / depth_.cols);
      if (reached > cost(here)) continue;
      if (here == goal) break;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const cv::Point next = here + cv::Point(dx, dy);
          if (next.x < 0 || next.y < 0 || next.x >= depth_.cols || next.y >= depth_.rows) continue;
          if (depth_(next) <= 0 && next != goal) continue;
          const float step = (dx != 0 && dy != 0 ? 1.4142f : 1.f) * (1 + 6 / (1 + depth_(next)));
          if (reached + step >= cost(next)) continue;
          cost(next) = reached + step;
          before(next) = index;
          queue.emplace(cost(next), next.y * depth_.cols + next.x);
        }
      }
    }
    if (cost(goal) >= 1e30f) return {};
    Polygon path;
    for (int index = goal.y * depth_.cols + goal.x; index >= 0;
         index = before(index / depth_.cols, index % depth_.cols)) {
      const int row = index / depth_.cols, column = index % depth_.cols;
      path.emplace_back((column - 0.5) / scale_, (row - 0.5) / scale_);
    }
    std::reverse(path.begin(), path.end());
    path.front() = from;
    path.back() = to;
    return path;
  }

  /// Radius of the largest disc in the leaf, px.
  double innerRadius() const {
    double deepest = 0;
    cv::minMaxLoc(depth_, nullptr, &deepest);
    return deepest / scale_;
  }

  /// Share of the straight line that lies on the leaf.
  double straightShare(QPointF from, QPointF to) const {
    int inside = 0;
    for (int i = 1; i < 60; ++i) inside += contains(from + (to - from) * (i / 60.0));
    return inside / 59.0;
  }

 private:
  cv::Point cell(QPointF p) const {
    return {std::clamp(static_cast<int>(p.x() * scale_) + 1, 1, depth_.cols - 2),
            std::clamp(static_cast<int>(p.y() * scale_) + 1, 1, depth_.rows - 2)};
  }

  cv::Mat1b mask_;
  double scale_ = 1;
  cv::Mat1f depth_;
};

struct Tip {
  QPointF place;
  double distance;
  double prominence;  ///< how far the border falls back on both sides, share of the distance
};

/// Places of the border that are farther from the root than all around them, in straight sight of it, farthest first.
std::vector<Tip> borderPeaks(const LeafGrid& grid, const Polygon& border, const LeafAxis& axis) {
  const double reach = length(axis.tip - axis.root);
  const size_t n = border.size(), window = std::max<size_t>(3, n / 28);
  std::vector<Tip> tips;
  for (size_t i = 0; i < n; ++i) {
    const double distance = length(border[i] - axis.root);
    if (distance < 0.3 * reach) continue;
    bool peak = true;
    double lowest = distance;
    for (size_t k = 1; k <= window && peak; ++k) {
      const double left = length(border[(i + n - k) % n] - axis.root), right = length(border[(i + k) % n] - axis.root);
      peak = left <= distance && right < distance;
      lowest = std::min({lowest, left, right});
    }
    if (!peak) continue;
    const bool onPetiole = !axis.petiole.empty() && length(border[i] - axis.petiole.front()) < 0.2 * reach;
    if (onPetiole || grid.straightShare(axis.root, border[i]) <= 0.97) continue;
    tips.push_back({border[i], distance, 1 - lowest / distance});
  }
  std::sort(tips.begin(), tips.end(), [](const Tip& a, const Tip& b) { return a.distance > b.distance; });
  return tips;
}

/// Main tips beside the first: far points of the border in other directions. Of a palmate leaf as many as stand out,
/// none of a pinnate one (`mains` 0); or the best `mains` - 1.
Polygon furtherTips(const LeafGrid& grid, const Polygon& border, const LeafAxis& axis, int mains) {
  if (mains == 1) return {};
  const double reach = length(axis.tip - axis.root);
  std::vector<Tip> tips = borderPeaks(grid, border, axis);
  const size_t most = mains > 1 ? static_cast<size_t>(mains) - 1 : 8;
  Polygon chosen{axis.tip};
  /// Where no other tip is within so many degrees of it.
  const auto add = [&](QPointF place, double apart) {
    const bool free = std::all_of(chosen.begin(), chosen.end(), [&](QPointF other) {
      const double angle = std::abs(QLineF(axis.root, place).angleTo(QLineF(axis.root, other)));
      return std::min(angle, 360 - angle) > apart;
    });
    if (free && chosen.size() <= most) chosen.push_back(place);
  };
  const auto addAll = [&](double distance, double prominence, double apart) {
    for (const Tip& tip : tips) {
      if (tip.distance >= distance * reach && tip.prominence >= prominence) add(tip.place, apart);
    }
  };
  constexpr double kApart = 27, kLobesApart = 20;  // degrees
  double apart = kApart;
  if (mains > 1) {
    apart = std::min(kApart, 150.0 / mains);
    std::stable_sort(tips.begin(), tips.end(), [](const Tip& a, const Tip& b) {
      return a.distance * (0.2 + a.prominence) > b.distance * (0.2 + b.prominence);
    });
    addAll(0, 0, apart);
  } else {
    addAll(0.55, 0.07, kApart);
    // Lobes that are cut deeply may be short and close together; once there are several, a blunt one is one too.
    if (chosen.size() > 2) addAll(0.4, 0.25, kLobesApart);
    if (chosen.size() > 2) addAll(0.7, 0.04, kApart);
  }
  // An outline without so many tips: the border is shared out by angle, more and more narrowly.
  for (; mains > 1 && chosen.size() <= most && apart > 3; apart *= 0.75) {
    for (size_t i = 0; i < border.size(); i += std::max<size_t>(1, border.size() / 400)) {
      const double distance = length(border[i] - axis.root);
      if (distance > 0.3 * reach && grid.straightShare(axis.root, border[i]) > 0.97) add(border[i], apart);
    }
  }
  chosen.erase(chosen.begin());
  // A single side tip is a tooth, not a second main vein.
  if (mains == 0 && chosen.size() < 2) chosen.clear();
  return chosen;
}

/// Tips all round where the root lies in the middle of the blade (a peltate leaf: nasturtium, lotus); else none.
Polygon tipsAllRound(const Polygon& border, const LeafAxis& axis) {
  constexpr int kRays = 8;
  const double reach = length(axis.tip - axis.root);
  double nearest = reach;
  for (const QPointF& p : border) nearest = std::min(nearest, length(p - axis.root));
  if (nearest < 0.4 * reach) return {};
  Polygon tips;
  const QLineF first(axis.root, axis.tip);
  for (int k = 1; k < kRays; ++k) {
    const auto off = [&](const QPointF& p) {
      const double angle = std::abs(first.angleTo(QLineF(axis.root, p)) - 360.0 * k / kRays);
      return std::min(angle, 360 - angle);
    };
    tips.push_back(*std::min_element(border.begin(), border.end(),
                                     [&](const QPointF& a, const QPointF& b) { return off(a) < off(b); }));
  }
  return tips;
}

bool crosses(const Polygon& line, const Polygon& other) {
  for (size_t i = 1; i < line.size(); ++i) {
    const QLineF a(line[i - 1], line[i]);
    for (size_t k = 1; k < other.size(); ++k) {
      QPointF at;
      if (a.intersects(QLineF(other[k - 1], other[k]), &at) == QLineF::BoundedIntersection) return true;
    }
  }
  return false;
}

class Grower {
 public:
  Grower(const QImage& mask, const Polygon& border, const LeafAxis& axis, const Polygon& tips,
         const VeinParameters& parameters)
      : grid_(mask), border_(border), axis_(axis), tips_(tips), parameters_(parameters), random_(parameters.seed, 101) {
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (const QPointF& p : border) {
      left = std::min(left, p.x()), right = std::max(right, p.x());
      top = std::min(top, p.y()), bottom = std::max(bottom, p.y());
    }
    size_ = std::max({right - left, bottom - top, 8.0});
    inner_ = grid_.innerRadius();
  }

  Veins grow() {
    Polygon tips = tips_;
    if (tips.empty()) {
      if (parameters_.mains == 0) tips = tipsAllRound(border_, axis_);
      if (tips.empty()) tips = furtherTips(grid_, border_, axis_, parameters_.mains);
      tips.insert(tips.begin(), axis_.tip);
    }
    for (size_t i = 0; i < tips.size(); ++i) addMain(tips[i], i == 0);
    const size_t mains = veins_.size();
    for (size_t i = 0; i < mains; ++i) addLaterals(static_cast<int>(i), mains > 1);
    return std::move(veins_);
  }

 private:
  /// Veins of a narrow blade are finer.
  double px(double at512) const { return at512 * std::min(size_, std::max(0.4 * size_, 10 * inner_)) / 512; }

  void addMain(QPointF tip, bool first) {
    Polygon way = grid_.middleWay(axis_.root, tip);
    if (way.size() < 2) way = {axis_.root, tip};
    // The middle way is only where to go; the vein itself is grown towards places on it.
    const double step = 0.05 * size_;
    Polygon line = curve(follow(way, step, 0.6 * parameters_.wiggle));
    if (!onLeaf(line)) line = smoothCurve(follow(way, step, 0));
    if (!onLeaf(line)) line = way;
    // What is left may touch the ground between two teeth, in a few places at most.
    std::erase_if(line, [&](const QPointF& p) { return !grid_.contains(p); });
    if (line.size() < 2) line = {axis_.root, tip};
    Vein vein;
    vein.order = 1;
    vein.startWidth = px(first ? 3.4 : 2.8);
    vein.endWidth = px(1.4);
    if (first && !axis_.petiole.empty()) {
      vein.points.assign(axis_.petiole.begin(), axis_.petiole.end() - 1);
    }
    petiolePoints_.push_back(vein.points.size());
    vein.points.insert(vein.points.end(), line.begin(), line.end());
    veins_.push_back(std::move(vein));
  }

  Polygon follow(const Polygon& way, double step, double wiggle) {
    Polygon line{way.front()};
    size_t ahead = 0;
    while (length(way.back() - line.back()) > step && static_cast<int>(line.size()) < kMostSteps) {
      while (ahead + 1 < way.size() && length(way[ahead] - line.back()) < 1.6 * step) ++ahead;
      const QPointF to = way[ahead] - line.back();
      if (length(to) < 1e-9) break;
      const double calm = std::min(1.0, length(way.back() - line.back()) / (4 * step) + 0.25);
      const double angle = random_.uniform(-wiggle, wiggle) * kDegree * calm;
      line.push_back(line.back() + turned(to / length(to), angle) * (step * random_.uniform(0.6, 1.0)));
    }
    line.push_back(way.back());
    return line;
  }

  Polygon curve(const Polygon& steps) const { return parameters_.bezier ? bezierCurve(steps) : smoothCurve(steps); }

  bool onLeaf(const Polygon& line) const {
    size_t outside = 0;
    for (const QPointF& p : line) outside += !grid_.contains(p);
    return outside * 50 <= line.size();
  }

  /// Where a ray from `base` leaves the leaf; a little before it.
  QPointF rayEnd(QPointF base, QPointF direction) const {
    QPointF last = base;
    for (double t = 2; t < 3 * size_; t += 2) {
      const QPointF p = base + t * direction;
      if (!grid_.contains(p) && !grid_.contains(p + 4 * direction)) break;
      last = p;
    }
    return base + 0.97 * (last - base);
  }

  void addLaterals(int mainIndex, bool palmate) {
    const size_t skip = petiolePoints_[static_cast<size_t>(mainIndex)];
    const Polygon main(veins_[static_cast<size_t>(mainIndex)].points.begin() + static_cast<std::ptrdiff_t>(skip),
                       veins_[static_cast<size_t>(mainIndex)].points.end());
    if (main.size() < 4) return;
    const double share = length(main.back() - main.front()) / length(axis_.tip - axis_.root);
    if (parameters_.laterals < 1) return;
    const int count = std::max(2, static_cast<int>(std::lround(parameters_.laterals * (palmate ? 0.75 : 1.0) * share)));
    // A palmate leaf's laterals keep away from the root, where its main veins are close.
    const double from = palmate ? std::max(0.22, parameters_.firstLateral) : parameters_.firstLateral;
    const double span = std::max(0.0, std::min(parameters_.lastLateral, palmate ? 0.88 : 1.0) - from);
    for (const int side : {-1, 1}) {
      if (side < 0 ? !parameters_.leftSide : !parameters_.rightSide) continue;
      std::vector<Polygon> before;
      for (int k = 0; k < count; ++k) {
        const double f = from + span * (k + random_.uniform(0.3, 0.7) + (side > 0 ? parameters_.stagger : 0)) / count;
        const auto index = std::min(main.size() - 3, static_cast<size_t>(f * static_cast<double>(main.size())));
        const QPointF base = main[index];
        const QPointF ahead = main[std::min(main.size() - 1, index + 8)] - main[index > 8 ? index - 8 : 0];
        const double spread = parameters_.basalAngle + (parameters_.apicalAngle - parameters_.basalAngle) * f;
        double angle = (palmate ? 0.75 : 1.0) * spread + 2.5 * random_.normal();
        for (int attempt = 0; attempt < 7; ++attempt, angle += 1.5) {
          const QPointF direction = turned(ahead / std::max(length(ahead), 1e-9), side * angle * kDegree);
          const QPointF target = rayEnd(base, direction);
          if (length(target - base) < std::min(0.03 * size_, 0.5 * inner_)) break;
          Polygon line =
              curve(growWalk(base, target, std::min(0.035 * size_, 0.5 * inner_), 0.7 * parameters_.wiggle, random_));
          if (!onLeaf(line)) line = {base, base + 0.5 * (target - base), target};
          if (!onLeaf(line) || crossesAny(line, before, mainIndex)) continue;
          Vein vein;
          vein.order = 2;
          vein.parent = mainIndex;
          vein.startWidth = px(2.2 - 0.7 * f);
          vein.endWidth = px(0.9);
          vein.points = line;
          veins_.push_back(vein);
          before.push_back(std::move(line));
          break;
        }
      }
    }
  }

  bool crossesAny(const Polygon& line, const std::vector<Polygon>& sameSide, int mainIndex) const {
    const Polygon shaft(line.begin() + static_cast<std::ptrdiff_t>(std::min<size_t>(3, line.size() - 2)), line.end());
    for (const Polygon& other : sameSide) {
      if (crosses(line, other)) return true;
    }
    for (size_t i = 0; i < veins_.size(); ++i) {
      const bool ownMain = static_cast<int>(i) == mainIndex;
      if (crosses(ownMain ? shaft : line, veins_[i].points)) return true;
    }
    return false;
  }

  LeafGrid grid_;
  const Polygon& border_;
  const LeafAxis& axis_;
  const Polygon& tips_;
  const VeinParameters& parameters_;
  RandomSequence random_;
  double size_ = 1, inner_ = 1;
  Veins veins_;
  std::vector<size_t> petiolePoints_;
};

}  // namespace

Polygon growWalk(QPointF from, QPointF to, double step, double turn, RandomSequence& random) {
  Polygon walk{from};
  while (length(to - walk.back()) > step && static_cast<int>(walk.size()) < kMostSteps) {
    const QPointF way = to - walk.back();
    const double distance = length(way);
    const double angle = random.uniform(-turn, turn) * kDegree * std::min(1.0, distance / (4 * step) + 0.25);
    walk.push_back(walk.back() + turned(way / distance, angle) * (step * random.uniform(0.6, 1.0)));
  }
  walk.push_back(to);
  return walk;
}

Veins growVeins(const QImage& mask, const Polygon& border, const LeafAxis& axis, const Polygon& tips,
                const VeinParameters& parameters) {
  Veins veins = Grower(mask, border, axis, tips, parameters).grow();
  if (parameters.micro) growMicroVeins(mask, parameters, veins);
  return veins;
}

QImage drawVeins(const Veins& veins, QSize size, QPointF origin, double scale, int highestOrder) {
  QImage image(size, QImage::Format_Grayscale8);
  image.fill(0);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  for (const Vein& vein : veins) {
    if (vein.order > highestOrder) continue;
    const Polygon points = throughPoints(vein.points);
    for (size_t i = 1; i < points.size(); ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(points.size());
      const double width = std::max(1.0, scale * (vein.startWidth + (vein.endWidth - vein.startWidth) * t));
      painter.setPen(QPen(Qt::white, width, Qt::SolidLine, Qt::RoundCap));
      painter.drawLine((points[i - 1] - origin) * scale, (points[i] - origin) * scale);
    }
  }
  return image;
}

}  // namespace windfall::model
