#include "model/sample/leaf_outline.h"

#include <QPolygonF>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/random.h"

namespace windfall::model {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSteps = 720;

/// Half the blade's width at height y of a pinnate leaf.
double halfWidth(LeafShape shape, double y, double side, double shift, double roughness) {
  const double t = std::clamp(y, 0.0, 1.0);
  switch (shape) {
    case LeafShape::Oak: {
      // Widest above the middle; sinuses between rounded lobes, shallower towards base and tip.
      const double body = 0.33 * std::pow(std::sin(kPi * std::pow(t, 0.86)), 0.62) * (0.55 + 0.65 * t);
      const double wave = 0.5 + 0.5 * std::cos(2 * kPi * (4.3 * std::pow(t, 0.9) + shift + 0.06 * side));
      const double depth = 0.62 * std::sin(kPi * std::clamp((t - 0.05) / 0.9, 0.0, 1.0));
      return body * (1 - depth * std::pow(wave, 1.5)) * roughness;
    }
    case LeafShape::Serrate: {
      const double body = 0.36 * std::pow(std::sin(kPi * std::pow(t, 0.62)), 0.85);
      const double phase = 17 * t + shift;
      const double fine = 51 * t + 2 * shift;
      const double teeth = 0.055 * (1 - (phase - std::floor(phase))) + 0.02 * (1 - (fine - std::floor(fine)));
      return body * (1 + teeth * std::sin(kPi * t)) * roughness;
    }
    default: {
      const double body = 0.31 * std::pow(std::sin(kPi * std::pow(t, 0.68)), 0.9);
      return body * (1 + 0.012 * std::sin(2 * kPi * (9 * t + shift))) * roughness;
    }
  }
}

/// Sideways bend of the midrib.
double bend(double y, double amount) { return amount * std::sin(1.2 * kPi * y) * y; }

void pinnateBlade(LeafShape shape, RandomSequence& random, double amount, LeafOutline& leaf) {
  const double shift = random.uniform();
  const double right = random.uniform(0.94, 1.06), left = random.uniform(0.94, 1.06);
  for (int i = 0; i <= kSteps; ++i) {
    const double y = static_cast<double>(i) / kSteps;
    leaf.blade.emplace_back(bend(y, amount) + halfWidth(shape, y, 1, shift, right), y);
  }
  for (int i = kSteps - 1; i > 0; --i) {
    const double y = static_cast<double>(i) / kSteps;
    leaf.blade.emplace_back(bend(y, amount) - halfWidth(shape, y, -1, shift, left), y);
  }
}

/// Five pointed lobes with a few teeth each, in polar coordinates around the base.
void palmateBlade(RandomSequence& random, std::vector<double>& lobes, LeafOutline& leaf) {
  const double spread = random.uniform(46, 51) * kPi / 180;
  const double reach[] = {0.52, 0.86, 1.0, 0.86, 0.52};
  std::vector<double> length;
  for (int k = 0; k < 5; ++k) {
    lobes.push_back((k - 2) * spread + random.uniform(-0.03, 0.03));
    length.push_back(reach[k] * random.uniform(0.95, 1.05));
  }
  for (int i = 0; i < 2 * kSteps; ++i) {
    const double angle = -0.94 * kPi + 1.88 * kPi * i / (2 * kSteps - 1);
    double radius = 0.17 * (1 - std::pow(std::abs(angle) / kPi, 3));
    for (int k = 0; k < 5; ++k) {
      const double off = std::abs(angle - lobes[k]) / (0.5 * spread);
      const double tooth = 0.10 * (0.5 + 0.5 * std::cos(2 * kPi * 2.5 * off)) * off * std::exp(-off * off * 0.9);
      const double lobe = length[k] * (0.30 + 0.70 * std::exp(-1.9 * std::pow(off, 1.35)) + tooth);
      if (off < 1.35) radius = std::max(radius, lobe * (1 - 0.35 * std::max(0.0, off - 0.85)));
    }
    leaf.blade.emplace_back(radius * std::sin(angle), radius * std::cos(angle));
  }
}

/// A vein from `base` along `angle` (from +y, clockwise), bending by `curl` towards +y, until it leaves the blade.
DrawnVein growTo(const QPolygonF& blade, QPointF base, double angle, double curl, double reach, double width) {
  DrawnVein vein;
  vein.width = width;
  vein.points.push_back(base);
  constexpr double kStep = 0.012;
  QPointF place = base;
  for (int i = 0; i < static_cast<int>(reach / kStep); ++i) {
    const double heading = angle * (1 - curl * i * kStep / reach);
    place += kStep * QPointF(std::sin(heading), std::cos(heading));
    if (!blade.containsPoint(place + 1.5 * kStep * QPointF(std::sin(heading), std::cos(heading)), Qt::OddEvenFill))
      break;
    vein.points.push_back(place);
  }
  return vein;
}

void laterals(const QPolygonF& blade, const std::vector<QPointF>& main, int count, double basal, double apical,
              double width, RandomSequence& random, LeafOutline& leaf) {
  const QPointF along = main.back() - main.front();
  const double lean = std::atan2(along.x(), along.y());
  for (const int side : {-1, 1}) {
    for (int k = 0; k < count; ++k) {
      const double f = 0.05 + 0.82 * (k + random.uniform(0.3, 0.7) + (side > 0 ? 0.25 : 0)) / count;
      const QPointF base = main[std::min(main.size() - 1, static_cast<size_t>(f * static_cast<double>(main.size())))];
      const double angle = (basal + (apical - basal) * f + 2.5 * random.normal()) * kPi / 180;
      leaf.veins.push_back(growTo(blade, base, lean + side * angle, 0.35, 0.75, width * (1 - 0.5 * f)));
    }
  }
}

}  // namespace

LeafOutline drawOutline(LeafShape shape, quint64 seed) {
  RandomSequence random(seed, 17);
  LeafOutline leaf;
  const double amount = random.uniform(-0.05, 0.05);
  const double petioleBend = random.uniform(-0.06, 0.06);
  const double petioleLength = shape == LeafShape::Oak ? 0.10 : shape == LeafShape::Maple ? 0.62 : 0.24;
  for (int i = 0; i <= 12; ++i) {
    const double t = i / 12.0;
    leaf.petiole.emplace_back(petioleBend * t * t, -petioleLength * t);
  }
  if (shape == LeafShape::Maple) {
    std::vector<double> lobes;
    palmateBlade(random, lobes, leaf);
    const QPolygonF blade(QList<QPointF>(leaf.blade.begin(), leaf.blade.end()));
    std::vector<DrawnVein> mains;
    for (const double lobe : lobes) mains.push_back(growTo(blade, {0, 0}, lobe, 0.02, 1.1, 0.017));
    leaf.veins = mains;
    for (const DrawnVein& main : mains) laterals(blade, main.points, 5, 46, 34, 0.007, random, leaf);
    return leaf;
  }
  pinnateBlade(shape, random, amount, leaf);
  const QPolygonF blade(QList<QPointF>(leaf.blade.begin(), leaf.blade.end()));
  DrawnVein main;
  main.width = 0.02;
  for (int i = 0; i <= 80; ++i) main.points.emplace_back(bend(i / 81.0, amount), i / 81.0);
  leaf.veins.push_back(main);
  const int count = shape == LeafShape::Oak ? 6 : shape == LeafShape::Serrate ? 9 : 8;
  laterals(blade, main.points, count, 58, 36, 0.009, random, leaf);
  return leaf;
}

}  // namespace windfall::model
