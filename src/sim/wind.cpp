#include "sim/wind.h"

#include <algorithm>
#include <cmath>

#include "kernels/wind_loops.h"

namespace windfall::sim {

namespace {
constexpr double kKeySpacing = 0.125;  // s between evaluations: 1.5 m at 12 m/s, about a cell
constexpr float kSmallestCell = 1.5f;  // m
constexpr float kMostNodes = 4096;
constexpr std::size_t kPiece = 64;  // nodes that a thread takes at once
constexpr float kMostSpeed = 1000;  // m/s
constexpr float kFading = 1;        // s from the end of the wind to calm

/// 0..limit; not a number counts as 0.
float within(float value, float limit) { return value > 0 ? std::min(value, limit) : 0; }
}  // namespace

WindField::WindField(const vec3& lower, const vec3& upper, const WindSettings& settings, int threads)
    : settings_(settings), threads_(std::max(threads, 1)) {
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

vec3 WindField::direction() const {
  const vec3 flat(settings_.direction.x, 0, settings_.direction.z);
  const float length = glm::length(flat);
  return length > 1e-6f && length < 1e30f ? flat / length : vec3(1, 0, 0);
}

float WindField::level(double time) const {
  return time < static_cast<double>(settings_.until) ? within(settings_.speed, kMostSpeed) : 0.f;
}

WindMoment WindField::moment(double time) const {
  WindMoment m;
  const double elapsed = time - anchor_.time;
  m.direction = direction();
  m.speed = within(settings_.speed, kMostSpeed);
  m.deviation = within(settings_.turbulence, 2) * m.speed;
  m.calm = std::clamp(1 - static_cast<float>(time - static_cast<double>(settings_.until)) / kFading, 0.f, 1.f);
  m.gustStrength = within(settings_.gustStrength, 5);
  m.gustSpacing = std::max(m.speed * std::max(within(settings_.gustPeriod, 1e4f), 0.5f), 5.f);
  const double speed = static_cast<double>(m.speed);
  m.gustTravel =
      (anchor_.fronts + elapsed * speed / static_cast<double>(m.gustSpacing)) * static_cast<double>(m.gustSpacing);
  for (int axis = 0; axis < 3; ++axis) {
    m.drift[axis] = anchor_.drift[axis] + elapsed * speed * static_cast<double>(m.direction[axis]);
  }
  m.turnover = anchor_.turnover + elapsed * 2 * static_cast<double>(m.deviation);
  m.seed = windfall::hash(settings_.seed, 0x57696e64u);
  return m;
}

void WindField::set(const WindSettings& settings, double time) {
  const WindMoment m = moment(time);
  anchor_.time = time;
  for (int axis = 0; axis < 3; ++axis) anchor_.drift[axis] = m.drift[axis];
  anchor_.fronts = m.gustTravel / static_cast<double>(m.gustSpacing);
  anchor_.turnover = m.turnover;
  settings_ = settings;
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
  const std::size_t pieces = (end - begin + kPiece - 1) / kPiece;
#pragma omp parallel for schedule(static) num_threads(threads_) if (pieces > 1)
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    const std::size_t first = begin + piece * kPiece;
    windRange(m, lattice, first, std::min(first + kPiece, end), nodes.data());
  }
}

void WindField::advance(double time) {
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

WindView WindField::view() const {
  WindView view;
  view.velocity = now_.data();
  view.nx = nx_;
  view.ny = ny_;
  view.nz = nz_;
  view.origin = origin_;
  view.perMetre = 1.0f / spacing_;
  return view;
}

}  // namespace windfall::sim
