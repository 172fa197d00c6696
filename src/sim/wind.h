// The wind around a scene: the field of kernels/wind_model.h, sampled onto a lattice as time goes on.
#pragma once

#include <vector>

#include "kernels/wind.h"
#include "kernels/wind_model.h"
#include "sim/settings.h"

namespace windfall::sim {

/// What of the wind is state: the paths of eddies and fronts up to the last change of the settings.
struct WindAnchor {
  double time = 0;              ///< s
  double drift[3] = {0, 0, 0};  ///< m
  double fronts = 0;            ///< fronts that have passed the origin
  double turnover = 0;          ///< m
};

/// Wind on a lattice. Every eighth of a second the field is evaluated at each node; between two such moments it is
/// interpolated, and the evaluation of the next one is spread over the steps. The result depends on the time and the
/// anchor alone. Bytes of memory are taken at construction only.
class WindField {
 public:
  /// Covers lower..upper (m, world).
  WindField(const vec3& lower, const vec3& upper, const WindSettings& settings, int threads);

  /// Changes the wind from `time` on; eddies and fronts go on from where they are.
  void set(const WindSettings& settings, double time);
  const WindSettings& settings() const { return settings_; }

  /// Brings the lattice to `time`, s.
  void advance(double time);
  WindView view() const;

  /// The field itself at any place and time, m/s.
  vec3 velocity(const vec3& place, double time) const { return windVelocity(moment(time), place); }
  WindMoment moment(double time) const;
  /// Mean speed at 10 m height, m/s; 0 once it is calm.
  float level(double time) const;
  /// Horizontal unit vector it blows to.
  vec3 direction() const;

  const WindAnchor& anchor() const { return anchor_; }
  /// Puts a saved anchor back; the lattice follows with the next `advance`.
  void restore(const WindAnchor& anchor);

 private:
  void evaluate(std::vector<vec4>& nodes, std::int64_t key, std::size_t begin, std::size_t end) const;

  WindSettings settings_;
  WindAnchor anchor_;
  int threads_;
  int nx_ = 0, ny_ = 0, nz_ = 0;
  vec3 origin_{0}, spacing_{1};
  std::vector<vec4> now_, first_, second_, third_;
  std::int64_t key_ = 0;  ///< first_ is key_, second_ key_ + 1, third_ key_ + 2
  bool valid_ = false;
  std::size_t prepared_ = 0;  ///< nodes of third_ that are done
};

}  // namespace windfall::sim
