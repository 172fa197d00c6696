#include "sim/wind_course.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace windfall::sim {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kPiece = 0.25;        // s between two sums
constexpr double kMostPieces = 400e3;  // of a long record they are longer

template <class Row>
bool isSound(const std::vector<Row>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!std::isfinite(rows[i].time) || (i > 0 && rows[i].time < rows[i - 1].time)) return false;
  }
  return !rows.empty();
}

/// Slope at key i that keeps the curve between its neighbours (Fritsch and Carlson 1980, weighted harmonic mean).
float slopeAt(std::span<const WindKey> curve, std::size_t i, float WindKey::*member) {
  if (i == 0 || i + 1 == curve.size()) return 0;
  const float before = curve[i].time - curve[i - 1].time, after = curve[i + 1].time - curve[i].time;
  if (!(before > 0) || !(after > 0)) return 0;
  const float a = (curve[i].*member - curve[i - 1].*member) / before;
  const float b = (curve[i + 1].*member - curve[i].*member) / after;
  if (a * b <= 0) return 0;
  const float u = 2 * after + before, v = after + 2 * before;
  return (u + v) / (u / a + v / b);
}

glm::dvec3 headingOf(double angle) { return {std::sin(angle), 0, -std::cos(angle)}; }

}  // namespace

CurvePoint curveAt(std::span<const WindKey> curve, float time) {
  if (curve.empty()) return {};
  if (!(time > curve.front().time)) return {curve.front().strength, curve.front().turn};
  if (time >= curve.back().time) return {curve.back().strength, curve.back().turn};
  const auto next =
      std::upper_bound(curve.begin(), curve.end(), time, [](float t, const WindKey& key) { return t < key.time; });
  const auto b = static_cast<std::size_t>(next - curve.begin()), a = b - 1;
  const float gap = curve[b].time - curve[a].time;
  const float t = gap > 0 ? (time - curve[a].time) / gap : 1;
  const auto hermite = [&](float WindKey::*member) {
    const float rise = gap * slopeAt(curve, a, member), fall = gap * slopeAt(curve, b, member);
    const float square = t * t, cube = square * t;
    return curve[a].*member * (2 * cube - 3 * square + 1) + rise * (cube - 2 * square + t) +
           curve[b].*member * (3 * square - 2 * cube) + fall * (cube - square);
  };
  return {hermite(&WindKey::strength), hermite(&WindKey::turn)};
}

WindTimeline::WindTimeline(const WindSettings& settings)
    : speed_(sim::within(settings.speed, kMostWindSpeed)),
      direction_(1, 0, 0),
      course_(settings.course),
      repeat_(settings.repeat) {
  const vec3 flat(settings.direction.x, 0, settings.direction.z);
  const float size = glm::length(flat);
  if (size > 1e-6f && size < 1e30f) direction_ = flat / size;
  angle_ = std::atan2(static_cast<double>(direction_.x), -static_cast<double>(direction_.z));
  if (course_ == WindCourse::Curve && isSound(settings.curve)) {
    curve_ = settings.curve;
    length_ = static_cast<double>(curve_.back().time);
  } else if (course_ == WindCourse::Recorded && isSound(settings.records)) {
    records_ = settings.records;
    length_ = static_cast<double>(records_.back().time);
  } else {
    course_ = WindCourse::Steady;
    return;
  }
  const double piece = std::max(kPiece, length_ / kMostPieces);
  knots_.push_back({});
  const auto pieces = static_cast<std::size_t>(std::ceil(length_ / piece));
  for (std::size_t i = 1; i <= pieces; ++i) {
    knots_.push_back(advanced(knots_.back(), std::min(length_, static_cast<double>(i) * piece)));
  }
}

WindTimeline::Flow WindTimeline::flowWithin(double time) const {
  const auto at = static_cast<float>(time);
  if (course_ == WindCourse::Curve) {
    const CurvePoint point = curveAt(curve_, at);
    return {sim::within(speed_ * sim::within(point.strength, 1000), kMostWindSpeed),
            angle_ + kDegree * static_cast<double>(point.turn)};
  }
  const auto next = std::upper_bound(records_.begin(), records_.end(), at,
                                     [](float t, const WindRecord& row) { return t < row.time; });
  const WindRecord& b = next == records_.end() ? records_.back() : *next;
  const WindRecord& a = next == records_.begin() ? b : *(next - 1);
  const float gap = b.time - a.time, share = gap > 0 ? std::clamp((at - a.time) / gap, 0.0f, 1.0f) : 0;
  // Directions the short way round.
  const float difference = b.heading - a.heading, turn = difference - 360 * std::round(difference / 360);
  return {sim::within(a.speed + (b.speed - a.speed) * share, kMostWindSpeed),
          kDegree * static_cast<double>(a.heading + turn * share)};
}

double WindTimeline::within(double time, double& rounds) const {
  rounds = 0;
  if (!(time > 0)) return 0;
  if (repeat_ && length_ > 0) {
    rounds = std::floor(time / length_);
    return std::clamp(time - rounds * length_, 0.0, length_);
  }
  return time;
}

WindTimeline::Flow WindTimeline::flow(double time) const {
  if (isSteady()) return {speed_, angle_};
  double rounds = 0;
  return flowWithin(within(time, rounds));
}

vec3 WindTimeline::direction(double time) const { return isSteady() ? direction_ : vec3(headingOf(flow(time).angle)); }

/// Sums up to `time`, the flow being taken at the middle.
WindTimeline::Knot WindTimeline::advanced(const Knot& from, double time) const {
  const Flow middle = flowWithin(0.5 * (from.time + time));
  const double way = static_cast<double>(middle.speed) * (time - from.time);
  return {time, from.distance + way, from.travel + way * headingOf(middle.angle)};
}

WindTimeline::Knot WindTimeline::sumTo(double time) const {
  double rounds = 0;
  const double at = within(time, rounds);
  const auto next =
      std::upper_bound(knots_.begin(), knots_.end(), at, [](double t, const Knot& knot) { return t < knot.time; });
  const Knot& from = next == knots_.begin() ? knots_.front() : *(next - 1);
  Knot sum = from;
  if (at > from.time) sum = advanced(from, at);
  // Inside a piece the way grows evenly, so that it is continuous at the piece's end.
  if (next != knots_.end() && next != knots_.begin() && next->time > from.time) {
    const double share = (at - from.time) / (next->time - from.time);
    sum.distance = from.distance + share * (next->distance - from.distance);
    sum.travel = from.travel + share * (next->travel - from.travel);
  }
  sum.distance += rounds * knots_.back().distance;
  sum.travel += rounds * knots_.back().travel;
  return sum;
}

glm::dvec3 WindTimeline::travel(double time) const {
  return isSteady() ? glm::dvec3(direction_) * (static_cast<double>(speed_) * time) : sumTo(time).travel;
}

double WindTimeline::distance(double time) const {
  return isSteady() ? static_cast<double>(speed_) * time : sumTo(time).distance;
}

}  // namespace windfall::sim
