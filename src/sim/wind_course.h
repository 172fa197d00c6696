// Mean speed and direction of the wind over time, and the way that it has carried the air.
#pragma once

#include <span>
#include <vector>

#include "sim/settings.h"

namespace windfall::sim {

/// Strength and turn of a curve at a time: monotone cubic between its keys (Fritsch and Carlson 1980), so a curve never
/// passes what its keys say; constant outside. An empty curve is 1 and 0.
struct CurvePoint {
  float strength = 1, turn = 0;
};
CurvePoint curveAt(std::span<const WindKey> curve, float time);

/// Settings as functions of time; all are defined for any time from 0 on, and depend on it alone.
class WindTimeline {
 public:
  explicit WindTimeline(const WindSettings& settings);

  float speed(double time) const { return flow(time).speed; }  ///< mean at 10 m height, m/s
  vec3 direction(double time) const;                           ///< horizontal unit vector it blows to
  glm::dvec3 travel(double time) const;                        ///< integral of velocity since time 0, m
  double distance(double time) const;                          ///< integral of speed since time 0, m
  bool isSteady() const { return knots_.empty(); }

 private:
  struct Flow {
    float speed = 0;
    double angle = 0;  ///< rad clockwise from north
  };
  /// Sums up to a moment of the course; between two the flow changes little.
  struct Knot {
    double time = 0, distance = 0;
    glm::dvec3 travel{0};
  };
  Flow flow(double time) const;
  Flow flowWithin(double time) const;
  double within(double time, double& rounds) const;
  Knot sumTo(double time) const;
  Knot advanced(const Knot& from, double time) const;

  float speed_;
  vec3 direction_;
  double angle_;
  WindCourse course_;
  bool repeat_;
  std::vector<WindKey> curve_;
  std::vector<WindRecord> records_;
  double length_ = 0;  ///< s, of the course
  std::vector<Knot> knots_;
};

/// 0..limit; not a number counts as 0.
inline float within(float value, float limit) { return value > 0 ? (value < limit ? value : limit) : 0; }
inline constexpr float kMostWindSpeed = 1000;  ///< m/s

}  // namespace windfall::sim
