#include "model/plant/grow/crown_volume.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/plant/grow/draw.h"

namespace windfall::model::growth {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kGoldenAngle = 2.39996322972865;
constexpr int kAttempts = 200;  ///< for each point that is wanted
enum Question : std::uint64_t { kHeight = 11, kAccept, kRadius, kAzimuth, kBallHeight, kBallRadius, kMesh };

/// One side of a drawn outline: height share to radius share, by height.
using Side = std::vector<std::pair<double, double>>;

Side sideOf(const CrownSettings& crown, bool left) {
  Side side;
  for (const QPointF& point : crown.profile) {
    const double x = left ? -point.x() : point.x();
    if (x >= 0) side.emplace_back(point.y(), x);
  }
  std::stable_sort(side.begin(), side.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return side;
}

/// Monotone cubic (Fritsch and Carlson 1980) through the points of a side; 0 outside.
double along(const Side& side, double u) {
  if (side.size() < 2 || u < side.front().first || u > side.back().first) return 0;
  std::size_t k = 0;
  while (k + 2 < side.size() && side[k + 1].first < u) ++k;
  const auto slope = [&](std::size_t i) {
    const double run = side[i + 1].first - side[i].first;
    return run > 1e-9 ? (side[i + 1].second - side[i].second) / run : 0.0;
  };
  const auto tangent = [&](std::size_t i) {
    if (i == 0) return slope(0);
    if (i + 1 == side.size()) return slope(i - 1);
    const double before = slope(i - 1), after = slope(i);
    return before * after <= 0 ? 0.0 : 2 * before * after / (before + after);
  };
  const double run = side[k + 1].first - side[k].first;
  if (run <= 1e-9) return std::max(side[k].second, side[k + 1].second);
  const double t = (u - side[k].first) / run, t2 = t * t, t3 = t2 * t;
  const double value = side[k].second * (2 * t3 - 3 * t2 + 1) + run * tangent(k) * (t3 - 2 * t2 + t) +
                       side[k + 1].second * (3 * t2 - 2 * t3) + run * tangent(k + 1) * (t3 - t2);
  return std::max(value, 0.0);
}

bool finite(std::initializer_list<double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

Status check(const ColonizationSettings& s, bool outlined, double height) {
  const CrownSettings& c = s.crown;
  if (!finite({height, c.base, c.radius, c.widest, c.lowPower, c.highPower, s.shell, s.lobeSize})) {
    return Error{"the crown has a number that is none"};
  }
  if (s.points < 1 || s.points > 400'000) return Error{"the crown wants 1 to 400,000 points"};
  if (!(s.shell > 0.05 && s.shell <= 3)) return Error{"the crown's shell must be 0.05 to 3"};
  if (!outlined) return ok();
  if (!(c.base >= 0 && c.base < height)) return Error{"the crown is empty: its base lies above the tree's top"};
  if (!(c.radius >= 0.01 && c.radius <= 100)) return Error{"the crown is empty: its radius must be 0.01 to 100 m"};
  if (!(c.lowPower >= 0.2 && c.lowPower <= 20 && c.highPower >= 0.2 && c.highPower <= 20)) {
    return Error{"the crown's roundness must be 0.2 to 20"};
  }
  if (c.profile.empty()) return ok();
  double area = 0;
  for (const bool left : {false, true}) {
    const Side side = sideOf(c, left);
    for (int i = 0; i < 64; ++i) area += along(side, (i + 0.5) / 64) / 64;
  }
  if (c.profile.size() < 2 || !(area > 1e-4))
    return Error{"the drawn crown encloses nothing: give it two points or more"};
  return ok();
}

/// Balls that the points are kept to, so that foliage clumps.
struct Lobes {
  std::vector<dvec3> centres;
  double radius = 0;
  bool contain(dvec3 point) const {
    return centres.empty() || std::any_of(centres.begin(), centres.end(), [&](dvec3 centre) {
             const dvec3 d = point - centre;
             return glm::dot(d, d) < radius * radius;
           });
  }
};

Lobes lobesOf(const ColonizationSettings& s, double height, quint64 seed) {
  Lobes lobes;
  lobes.radius = s.lobeSize * s.crown.radius;
  const double base = s.crown.base;
  for (int k = 0; k < s.lobes; ++k) {
    const auto who = static_cast<std::uint64_t>(k);
    const double u = 0.08 + 0.86 * (k + draw(seed, who, kBallHeight)) / s.lobes;
    const double r = s.crown.radius * crownRadius(s.crown, u) * (0.45 + 0.4 * draw(seed, who, kBallRadius));
    const double azimuth = kGoldenAngle * k;
    lobes.centres.emplace_back(r * std::cos(azimuth), base + u * (height - base), r * std::sin(azimuth));
  }
  return lobes;
}

Result<std::vector<dvec3>> meshPoints(const ColonizationSettings& s, const SourceFile& file, quint64 seed,
                                      Progress& progress) {
  const Result<ClosedMesh> mesh = readCrownMesh(file, progress);
  if (!mesh) return mesh.error();
  std::vector<dvec3> points;
  const dvec3 size = mesh->upper() - mesh->lower();
  for (std::uint64_t k = 0; points.size() < at(s.points); ++k) {
    if (k > static_cast<std::uint64_t>(s.points) * kAttempts) {
      return Error{"the crown's mesh encloses no volume: it is too thin or not closed"};
    }
    if (k % 4096 == 0 && progress.cancelled()) return Error{"cancelled", true};
    const dvec3 p =
        mesh->lower() + size * dvec3(draw(seed, k, kMesh), draw(seed, k, kMesh + 1), draw(seed, k, kMesh + 2));
    if (mesh->contains(p)) points.push_back(p);
  }
  return points;
}

}  // namespace

double crownRadius(const CrownSettings& crown, double u, bool left) {
  if (!crown.profile.empty()) {
    const Side own = sideOf(crown, left);
    return along(own.size() >= 2 ? own : sideOf(crown, !left), u);
  }
  const double widest = std::clamp(crown.widest, 0.001, 0.999);
  const double w = u < widest ? (widest - u) / widest : (u - widest) / (1 - widest);
  const double p = u < widest ? crown.lowPower : crown.highPower;
  return std::pow(std::max(1 - std::pow(std::clamp(w, 0.0, 1.0), p), 0.0), 1 / p);
}

Result<std::vector<dvec3>> crownPoints(const ColonizationSettings& s, const SourceFile& mesh, double height,
                                       quint64 seed, Progress& progress) {
  if (const Status good = check(s, mesh.isEmpty(), height); !good) return good.error();
  if (!mesh.isEmpty()) return meshPoints(s, mesh, seed, progress);
  // The radius is looked up: a drawn outline costs too much for every attempt.
  constexpr int kSteps = 512;
  std::vector<double> right(kSteps + 1), leftSide(kSteps + 1);
  double most = 0;
  for (int i = 0; i <= kSteps; ++i) {
    right[at(i)] = crownRadius(s.crown, static_cast<double>(i) / kSteps, false);
    leftSide[at(i)] = crownRadius(s.crown, static_cast<double>(i) / kSteps, true);
    most = std::max({most, right[at(i)], leftSide[at(i)]});
  }
  const Lobes lobes = lobesOf(s, height, seed);
  std::vector<dvec3> points;
  for (std::uint64_t k = 0; points.size() < at(s.points); ++k) {
    if (k > static_cast<std::uint64_t>(s.points) * kAttempts) return Error{"the crown is empty: nothing fits into it"};
    if (k % 4096 == 0 && progress.cancelled()) return Error{"cancelled", true};
    const double u = draw(seed, k, kHeight), phi = kTurn * draw(seed, k, kAzimuth);
    const double place = u * kSteps;
    const auto i = static_cast<std::size_t>(std::min(place, kSteps - 1.0));
    const double t = place - static_cast<double>(i);
    const double toRight = std::pow(std::cos(phi / 2), 2);
    const double r = (right[i] * (1 - t) + right[i + 1] * t) * toRight +
                     (leftSide[i] * (1 - t) + leftSide[i + 1] * t) * (1 - toRight);
    if (draw(seed, k, kAccept) * most * most > r * r) continue;
    const double f = std::pow(draw(seed, k, kRadius), s.shell) * r * s.crown.radius;
    const dvec3 point(f * std::cos(phi), s.crown.base + u * (height - s.crown.base), f * std::sin(phi));
    if (lobes.contain(point)) points.push_back(point);
  }
  return points;
}

}  // namespace windfall::model::growth
