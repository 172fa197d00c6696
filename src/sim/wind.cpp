#include "sim/wind.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/wind_loops.h"
#include "sim/wind_eddies.h"

namespace windfall::sim {

namespace {
constexpr double kKeySpacing = 0.125;  // s between evaluations: 1.5 m at 12 m/s, about a cell
constexpr float kSmallestCell = 1.5f;  // m
constexpr float kMostNodes = 4096;
constexpr std::size_t kPiece = 64;    // nodes that a thread takes at once
constexpr float kFading = 1;          // s from the end of the wind to calm
constexpr float kLevelRatio = 1.25f;  // between two levels of a wind that follows a course
constexpr float kSector = std::numbers::pi_v<float> / 8;
/// Ways of the eddies relative to the mean wind, in shares of the turnover.
constexpr double kSlipLarge[3] = {0.5, 0.8, -0.4}, kSlipSmall[3] = {0.3, -0.7, 0.4};
constexpr double kRising = 0.2;  // m/s of warm air, which keeps small eddies alive in a calm

/// A way in nodes of the tile without the whole tiles in it.
vec3 scrolled(const double (&metres)[3], double perMetre) {
  constexpr double kNodes[3] = {kTileX, kTileY, kTileZ};
  vec3 result(0);
  for (int i = 0; i < 3; ++i) {
    const double nodes = metres[i] * perMetre;
    result[i] = static_cast<float>(nodes - std::floor(nodes / kNodes[i]) * kNodes[i]);
  }
  return result;
}

bool isFinite(const vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool jetOf(const Fan& fan, double time, FanJet& jet) {
  const float length = glm::length(fan.direction);
  if (!fan.on || !(fan.strength > 0) || !isFinite(fan.position) || !(length > 1e-6f && length < 1e30f)) return false;
  jet.position = fan.position;
  jet.axis = fan.direction / length;
  jet.speed = within(fan.strength, 200);
  jet.radius = std::clamp(fan.radius, 0.01f, 100.f);
  jet.slope = std::tan(std::clamp(fan.spread, 0.f, 60.f) * std::numbers::pi_v<float> / 180);
  double way[3];
  // Eddies travel at about half the speed of the jet's middle (its mean over the section).
  for (int i = 0; i < 3; ++i) way[i] = 0.5 * static_cast<double>(jet.speed * jet.axis[i]) * time;
  jet.scroll = scrolled(way, static_cast<double>(kSmallPerMetre));
  return true;
}
}  // namespace

WindField::WindField(const vec3& lower, const vec3& upper, const WindSettings& settings, int threads)
    : settings_(settings),
      timeline_(settings),
      tile_(eddyTile(windfall::hash(settings.seed, 0x57696e64u))),
      threads_(std::max(threads, 1)) {
  const vec3 size = glm::max(upper - lower, vec3(1));
  const float cell = std::max(kSmallestCell, std::cbrt(size.x * size.y * size.z / kMostNodes));
  const auto count = [&](float extent) { return std::clamp(static_cast<int>(std::ceil(extent / cell)) + 1, 2, 256); };
  nx_ = count(size.x);
  ny_ = count(size.y);
  nz_ = count(size.z);
  origin_ = lower;
  spacing_ = size / vec3(static_cast<float>(nx_ - 1), static_cast<float>(ny_ - 1), static_cast<float>(nz_ - 1));
  const std::size_t nodes =
      static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_) * static_cast<std::size_t>(nz_);
  for (auto* buffer : {&now_, &first_, &second_, &third_}) buffer->assign(nodes, vec4(0));
}

void WindField::setFoliage(std::span<const Foliage> foliage) {
  shelter_ = ShelterMap(foliage, {nx_, ny_, origin_, spacing_}, nz_, threads_);
  valid_ = false;
}

float WindField::level(double time) const {
  if (time >= static_cast<double>(settings_.until)) return 0;
  if (timeline_.isSteady()) return timeline_.speed(time);
  const float speed = timeline_.speed(std::floor(std::max(time, 0.0)));
  return speed < 0.5f ? 0.5f : 0.5f * std::pow(kLevelRatio, std::ceil(std::log(speed / 0.5f) / std::log(kLevelRatio)));
}

vec3 WindField::direction(double time) const {
  if (timeline_.isSteady()) return timeline_.direction(time);
  const vec3 now = timeline_.direction(std::floor(std::max(time, 0.0)));
  const float angle = kSector * std::round(std::atan2(now.x, -now.z) / kSector);
  return {std::sin(angle), 0, -std::cos(angle)};
}

WindField::Paths WindField::pathsAt(double time) const {
  const glm::dvec3 way = timeline_.travel(time) - timeline_.travel(anchor_.time);
  const double length = timeline_.distance(time) - timeline_.distance(anchor_.time);
  const auto period = static_cast<double>(std::max(within(settings_.gustPeriod, 1e4f), 0.5f));
  Paths paths;
  for (int axis = 0; axis < 3; ++axis) paths.drift[axis] = anchor_.drift[axis] + way[axis];
  paths.fronts = anchor_.fronts + (time - anchor_.time) / period;
  paths.turnover = anchor_.turnover + length * static_cast<double>(within(settings_.turbulence, 2));
  return paths;
}

WindMoment WindField::moment(double time) const {
  WindMoment m;
  const Paths paths = pathsAt(time);
  m.direction = timeline_.direction(time);
  m.speed = timeline_.speed(time);
  m.deviation = within(settings_.turbulence, 2) * m.speed;
  m.calm = std::clamp(1 - static_cast<float>(time - static_cast<double>(settings_.until)) / kFading, 0.f, 1.f);
  m.canopy = within(settings_.canopyHeight, 200);
  m.gustStrength = within(settings_.gustStrength, 5);
  m.gustSpacing = std::max(m.speed * std::max(within(settings_.gustPeriod, 1e4f), 0.5f), 5.f);
  m.gustTravel = paths.fronts * static_cast<double>(m.gustSpacing);
  if (m.deviation > 0) m.tile = tile_->data();
  double first[3], second[3];
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = paths.drift[axis] + kSlipLarge[axis] * paths.turnover;
    second[2 - axis] = paths.drift[axis] - kSlipLarge[axis] * paths.turnover;  // its x and z change places
  }
  m.scroll[0] = scrolled(first, static_cast<double>(kLargePerMetre));
  m.scroll[1] = scrolled(second, static_cast<double>(kLargePerMetre));
  m.seed = windfall::hash(settings_.seed, 0x57696e64u);
  return m;
}

void WindField::set(const WindSettings& settings, double time) {
  const Paths paths = pathsAt(time);
  anchor_.time = time;
  std::copy(std::begin(paths.drift), std::end(paths.drift), anchor_.drift);
  anchor_.fronts = paths.fronts;
  anchor_.turnover = paths.turnover;
  if (settings.seed != settings_.seed) tile_ = eddyTile(windfall::hash(settings.seed, 0x57696e64u));
  settings_ = settings;
  timeline_ = WindTimeline(settings);
  valid_ = false;
}

void WindField::restore(const WindAnchor& anchor) {
  anchor_ = anchor;
  valid_ = false;
}

void WindField::evaluate(std::vector<vec4>& nodes, std::int64_t key, std::size_t begin, std::size_t end) const {
  const WindMoment m = moment(static_cast<double>(key) * kKeySpacing);
  if (m.calm <= 0 || m.speed <= 0) {
    std::fill(nodes.begin() + static_cast<std::ptrdiff_t>(begin), nodes.begin() + static_cast<std::ptrdiff_t>(end),
              vec4(0));
    return;
  }
  const WindLattice lattice{nx_, ny_, origin_, spacing_};
  const float shelter = shelter_.empty() ? 0 : within(settings_.shelter, 1);
  const std::size_t pieces = (end - begin + kPiece - 1) / kPiece;
#pragma omp parallel for schedule(static) num_threads(threads_) if (pieces > 1)
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    const std::size_t first = begin + piece * kPiece, last = std::min(first + kPiece, end);
    windRange(m, lattice, first, last, nodes.data());
    if (shelter <= 0) continue;
    for (std::size_t i = first; i < last; ++i) nodes[i] *= 1 - shelter * (1 - shelter_.at(i, m.direction));
  }
}

void WindField::advance(double time) {
  time_ = time;
  const auto key = static_cast<std::int64_t>(std::floor(time / kKeySpacing));
  const std::size_t count = now_.size();
  if (valid_ && key == key_ + 1) {
    evaluate(third_, key_ + 2, prepared_, count);
    first_.swap(second_);
    second_.swap(third_);
    prepared_ = 0;
  } else if (!valid_ || key != key_) {
    evaluate(first_, key, 0, count);
    evaluate(second_, key + 1, 0, count);
    prepared_ = 0;
  }
  key_ = key;
  valid_ = true;
  const double part = std::clamp(time / kKeySpacing - static_cast<double>(key), 0.0, 1.0);
  // A little ahead of the clock, so that the next moment is ready before it is asked for.
  const auto wanted = std::min(count, static_cast<std::size_t>((part * 1.25 + 0.1) * static_cast<double>(count)));
  if (wanted > prepared_) {
    evaluate(third_, key + 2, prepared_, wanted);
    prepared_ = wanted;
  }
  const float f = static_cast<float>(part);
  for (std::size_t i = 0; i < count; ++i) now_[i] = first_[i] * (1 - f) + second_[i] * f;
}

WindView WindField::viewAt(double time) const {
  WindView view;
  view.velocity = now_.data();
  view.nx = nx_;
  view.ny = ny_;
  view.nz = nz_;
  view.origin = origin_;
  view.perMetre = 1.0f / spacing_;
  view.eddies = tile_->data();
  view.eddiesPerMetre = kSmallPerMetre;
  const Paths paths = pathsAt(time);
  double way[3];
  for (int axis = 0; axis < 3; ++axis) way[axis] = paths.drift[axis] + kSlipSmall[axis] * paths.turnover;
  way[1] += kRising * time;
  view.eddyScroll = scrolled(way, static_cast<double>(kSmallPerMetre));
  for (const Fan& fan : settings_.fans) {
    if (view.fanCount < kMostFans && jetOf(fan, time, view.fans[view.fanCount])) ++view.fanCount;
  }
  view.pull = pull_;
  return view;
}

WindView WindField::view() const { return viewAt(time_); }

vec3 WindField::velocity(const vec3& place, double time) const {
  const WindMoment m = moment(time);
  const vec4 node = windNode(m, place, windProfile(place.y, m.canopy));
  const WindView view = viewAt(time);
  vec3 velocity(node);
  if (node.w > 0) velocity += smallEddies(view, place, node.w);
  for (int i = 0; i < view.fanCount; ++i) velocity += jetAt(view.fans[i], view.eddies, view.eddiesPerMetre, place);
  return velocity;
}

}  // namespace windfall::sim
