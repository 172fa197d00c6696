#include "sim/wind_streaks.h"

#include <algorithm>
#include <cmath>

#include "kernels/random.h"

namespace windfall::sim {

namespace {
constexpr float kStep = 1.f / 30;                   // s between two points of a streak
constexpr float kShortest = 1.2f, kLongest = 3.2f;  // s of life
constexpr float kFade = 0.45f;                      // s at birth and end
constexpr float kFull = 7;                          // m/s from which a streak is seen fully
constexpr int kMostSteps = 8;                       // of one call; a long pause need not be made up
}  // namespace

WindStreaks::WindStreaks(std::uint32_t count)
    : streaks_(count), points_(static_cast<std::size_t>(count) * kPoints, vec4(0)) {}

void WindStreaks::clear() {
  std::fill(streaks_.begin(), streaks_.end(), Streak{});
  std::fill(points_.begin(), points_.end(), vec4(0));
  left_ = 0;
}

void WindStreaks::begin(std::uint32_t index, const WindView& wind) {
  Streak& streak = streaks_[index];
  const std::uint32_t birth = streak.births++;
  const auto draw = [&](std::uint32_t what) { return uniform(0x57726b73u, index, birth, what); };
  const vec3 size = vec3(wind.nx - 1, wind.ny - 1, wind.nz - 1) / wind.perMetre;
  vec3 place = wind.origin + size * vec3(draw(0), 0.04f + 0.86f * draw(1), draw(2));
  // Some start at the fans, so that their wind is seen.
  if (wind.fanCount > 0 && draw(5) < 0.3f) {
    const FanJet& fan = wind.fans[static_cast<int>(draw(6) * static_cast<float>(wind.fanCount))];
    const float angle = 6.2831853f * draw(7), reach = fan.radius * std::sqrt(draw(8));
    const vec3 side = glm::normalize(glm::cross(fan.axis, std::abs(fan.axis.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0)));
    place = fan.position + reach * (std::cos(angle) * side + std::sin(angle) * glm::cross(fan.axis, side));
  }
  streak.life = kShortest + (kLongest - kShortest) * draw(3);
  // At the very first all would come at once.
  streak.age = birth == 0 ? streak.life * draw(4) : 0;
  for (int i = 0; i < kPoints; ++i)
    points_[static_cast<std::size_t>(index) * kPoints + static_cast<std::size_t>(i)] = vec4(place, 0);
}

void WindStreaks::move(float h, const WindView& wind) {
  const vec3 upper = wind.origin + vec3(wind.nx - 1, wind.ny - 1, wind.nz - 1) / wind.perMetre;
  for (std::uint32_t s = 0; s < streaks_.size(); ++s) {
    Streak& streak = streaks_[s];
    vec4* points = &points_[static_cast<std::size_t>(s) * kPoints];
    const vec3 head(points[0]);
    const bool outside = glm::any(glm::lessThan(head, wind.origin)) || glm::any(glm::greaterThan(head, upper));
    if (streak.age >= streak.life || outside || streak.births == 0) begin(s, wind);
    const vec3 from(points[0]);
    // Midpoint: streaks follow curved gusts.
    const vec3 middle = from + 0.5f * h * windAt(wind, from);
    const vec3 velocity = windAt(wind, middle);
    streak.age += h;
    const float fade = std::clamp(std::min(streak.age, streak.life - streak.age) / kFade, 0.f, 1.f);
    std::copy_backward(points, points + kPoints - 1, points + kPoints);
    vec3 place = from + h * velocity;
    place.y = std::max(place.y, 0.05f);
    points[0] = vec4(place, fade * std::min(1.f, glm::length(velocity) / kFull));
  }
}

void WindStreaks::advance(double seconds, const WindView& wind) {
  if (wind.velocity == nullptr || !(seconds > 0)) return;
  left_ = std::min(left_ + seconds, kMostSteps * static_cast<double>(kStep));
  while (left_ >= static_cast<double>(kStep)) {
    left_ -= static_cast<double>(kStep);
    move(kStep, wind);
  }
}

}  // namespace windfall::sim
