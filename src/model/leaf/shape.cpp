#include "model/leaf/shape.h"

#include <QLineF>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "kernels/random.h"
#include "model/leaf/image_cv_private.h"

namespace windfall::model {

namespace {

constexpr std::uint32_t kStream = 401;

double length(QPointF v) { return std::hypot(v.x(), v.y()); }

/// Rises over three quarters of a period and falls over the rest, -0.5..0.5: teeth that point to the tip.
double tooth(double t) {
  t -= std::floor(t);
  return (t < 0.75 ? t / 0.75 : (1 - t) / 0.25) - 0.5;
}

/// Normal, but never farther than two deviations out: no leaf is a monster.
double draw(RandomSequence& random, double deviation) { return deviation * std::clamp(random.normal(), -2.0, 2.0); }

/// A round place with an uneven rim, as an insect leaves it.
std::vector<cv::Point> blob(QPointF centre, double radius, RandomSequence& random) {
  std::vector<cv::Point> outline;
  const double a = random.uniform(0.1, 0.3), b = random.uniform(0.05, 0.2);
  const double pa = random.uniform(0, 6.28), pb = random.uniform(0, 6.28);
  for (int i = 0; i < 40; ++i) {
    const double angle = 2 * std::numbers::pi * i / 40;
    const double r = radius * (1 + a * std::sin(2 * angle + pa) + b * std::sin(3 * angle + pb));
    outline.emplace_back(static_cast<int>(std::lround(centre.x() + r * std::cos(angle))),
                         static_cast<int>(std::lround(centre.y() + r * std::sin(angle))));
  }
  return outline;
}

/// What the frame cuts off already, a long petiole most often, may be cut off again.
bool staysInside(const ShapeMap& map, const LeafStages& of) {
  const QRectF room = QRectF(of.frame).adjusted(2, 2, -2, -2);
  return std::all_of(of.border.begin(), of.border.end(),
                     [&](QPointF p) { return !room.contains(p) || room.contains(map.map(p)); });
}

/// The map of this seed, made to fit: smaller first, then less varied.
ShapeMap fittingMap(const LeafStages& of, quint64 seed) {
  const ShapeParameters& parameters = of.made.parameters.shape;
  for (double strength = 1; strength > 0.05; strength *= 0.75) {
    for (const double size : {1.0, 0.94, 0.88, 0.82}) {
      const ShapeMap map(parameters, of.root, of.tip, seed, strength, size);
      if (staysInside(map, of)) return map;
    }
  }
  return {parameters, of.root, of.tip, seed, 0};
}

cv::Mat1b warped(const QImage& mask, const ShapeMap& map, const QRect& frame) {
  cv::Mat2f places(mask.height(), mask.width(), cv::Vec2f(-1, -1));
  for (int y = std::max(0, frame.top()); y <= std::min(mask.height() - 1, frame.bottom()); ++y) {
    for (int x = std::max(0, frame.left()); x <= std::min(mask.width() - 1, frame.right()); ++x) {
      const QPointF from = map.unmap(QPointF(x, y));
      places(y, x) = {static_cast<float>(from.x()), static_cast<float>(from.y())};
    }
  }
  cv::Mat1b result;
  cv::remap(grayView(mask), result, places, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, 0);
  return result > 127;
}

/// Eats holes inside and bites at the margin; never near the root, where the leaf would come loose.
void eat(cv::Mat1b& mask, const LeafStages& of, const ShapeMap& map, RandomSequence& random) {
  const ShapeParameters& parameters = of.made.parameters.shape;
  const double size = length(of.tip - of.root);
  const int holes = static_cast<int>(random.below(static_cast<std::uint32_t>(parameters.holes) + 1));
  const int bites = static_cast<int>(random.below(static_cast<std::uint32_t>(parameters.bites) + 1));
  const auto far = [&](QPointF p) { return length(p - of.root) > 0.2 * size && length(p - of.tip) > 0.12 * size; };
  cv::Mat1f depth;
  cv::distanceTransform(mask, depth, cv::DIST_L2, 3);
  const QRect frame = of.frame & QRect(0, 0, mask.cols, mask.rows);
  for (int made = 0, tries = 0; made < holes && tries < 400; ++tries) {
    const QPointF p(random.uniform(frame.left(), frame.right()), random.uniform(frame.top(), frame.bottom()));
    const double radius = size * random.uniform(0.008, 0.035);
    if (depth(static_cast<int>(p.y()), static_cast<int>(p.x())) < 1.6 * radius || !far(p)) continue;
    cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{blob(p, radius, random)}, 0);
    ++made;
  }
  for (int made = 0, tries = 0; made < bites && tries < 400; ++tries) {
    const QPointF p = map.map(of.border[random.below(static_cast<std::uint32_t>(of.border.size()))]);
    const double radius = size * random.uniform(0.02, 0.06);
    if (!far(p)) continue;
    cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{blob(p, radius, random)}, 0);
    ++made;
  }
}

/// The part that the root is on, or the largest: bites may cut pieces off.
cv::Mat1b largestPart(const cv::Mat1b& mask) {
  cv::Mat1i labels, stats;
  cv::Mat1d centres;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centres, 8);
  int best = 0;
  for (int i = 1; i < count; ++i) {
    if (best == 0 || stats(i, cv::CC_STAT_AREA) > stats(best, cv::CC_STAT_AREA)) best = i;
  }
  return best > 0 ? cv::Mat1b(labels == best) : mask;
}

}  // namespace

ShapeMap::ShapeMap(const ShapeParameters& parameters, QPointF root, QPointF tip, quint64 seed, double strength,
                   double size)
    : root_(root), axis_(tip - root), length_(std::max(1.0, length(tip - root))), size_(size) {
  axis_ /= length_;
  RandomSequence random(seed, kStream);
  const double aspect = draw(random, strength * parameters.aspect);
  const double halves = draw(random, 0.5 * strength * parameters.asymmetry);
  bend_ = draw(random, 0.25 * strength * parameters.asymmetry);
  scale_[0] = std::exp(aspect + halves);
  scale_[1] = std::exp(aspect - halves);
  for (auto& side : lobes_) {
    for (Wave& wave : side) {
      wave = {draw(random, 1.4 * strength * parameters.lobes), random.uniform(1.0, 4.0), random.uniform(0, 6.28)};
      // Short waves are shallow: an entire margin stays one.
      wave.amplitude /= wave.count * wave.count;
    }
  }
  for (Wave& wave : shift_) {
    // The slope of all three together stays below 1: the map can be undone.
    const double count = random.uniform(0.8, 2.5);
    wave = {std::clamp(draw(random, 0.3 * strength * parameters.lobes), -0.28, 0.28) / (2 * std::numbers::pi * count),
            count, random.uniform(0, 6.28)};
  }
  teeth_ = strength * std::min(0.9, parameters.teeth);
  toothCount_ = std::max(1, parameters.toothCount);
  for (double& phase : toothPhase_) phase = random.uniform();
}

double ShapeMap::waves(const Wave (&of)[3], double along) const {
  double sum = 0;
  for (const Wave& wave : of) sum += wave.amplitude * std::sin(2 * std::numbers::pi * wave.count * along + wave.phase);
  return sum;
}

double ShapeMap::width(double along, bool left) const {
  const int side = left ? 0 : 1;
  const double inside = std::clamp(along, -0.3, 1.0);
  // Teeth begin beyond the base and end before the tip.
  const double toothed = std::clamp(std::min(inside, 1 - inside) * 12, 0.0, 1.0);
  return scale_[side] * std::exp(waves(lobes_[side], inside)) *
         (1 + teeth_ * toothed * tooth(toothCount_ * inside + toothPhase_[side]));
}

double ShapeMap::shifted(double along) const {
  if (along <= 0 || along >= 1) return along;
  const double ends = std::sin(std::numbers::pi * along);
  return along + 0.5 * ends * waves(shift_, along);
}

double ShapeMap::unshifted(double along) const {
  double from = along;
  for (int i = 0; i < 12; ++i) from += along - shifted(from);
  return from;
}

double ShapeMap::bend(double along) const {
  const double t = std::clamp(along, 0.0, 1.0);
  return length_ * bend_ * 4 * t * (1 - t);
}

QPointF ShapeMap::map(QPointF photo) const {
  const QPointF d = photo - root_, across(-axis_.y(), axis_.x());
  const double along = QPointF::dotProduct(d, axis_) / length_, beside = QPointF::dotProduct(d, across);
  const double to = shifted(along);
  return root_ + size_ * (to * length_ * axis_ + (beside * width(along, beside < 0) + bend(along)) * across);
}

QPointF ShapeMap::unmap(QPointF varied) const {
  const QPointF d = (varied - root_) / size_, across(-axis_.y(), axis_.x());
  const double along = unshifted(QPointF::dotProduct(d, axis_) / length_);
  const double beside = QPointF::dotProduct(d, across) - bend(along);
  return root_ + along * length_ * axis_ + beside / width(along, beside < 0) * across;
}

Leaf variedLeaf(const LeafStages& of, quint64 seed) {
  const ShapeMap map = fittingMap(of, seed);
  Leaf leaf = of.made;
  cv::Mat1b mask = warped(of.mask, map, of.frame);
  RandomSequence random(seed, kStream + 1);
  eat(mask, of, map, random);
  leaf.mask = toGray(largestPart(mask));
  leaf.root = of.root;
  for (QPointF& tip : leaf.tips) tip = map.map(tip);
  for (QPointF& marker : leaf.markers) marker = map.map(marker);
  for (RegionPair& pair : leaf.regionPairs) pair.target = map.map(pair.target);
  if (!of.made.veins.empty() || of.made.parameters.veins.fromPhoto) {
    leaf.veins = of.veins;
    for (Vein& vein : leaf.veins) {
      for (QPointF& point : vein.points) point = map.map(point);
    }
  } else {
    leaf.parameters.veins.seed = hash(seed, kStream + 2, static_cast<std::uint32_t>(of.made.parameters.veins.seed));
  }
  return leaf;
}

}  // namespace windfall::model
