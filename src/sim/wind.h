// The wind around a scene: the field of kernels/wind_model.h, sampled onto a lattice as time goes on.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "kernels/wind.h"
#include "kernels/wind_model.h"
#include "sim/settings.h"
#include "sim/wind_course.h"
#include "sim/wind_shelter.h"

namespace windfall::sim {

/// What of the wind is state: the paths of eddies and fronts up to the last change of the settings.
struct WindAnchor {
  double time = 0;              ///< s
  double drift[3] = {0, 0, 0};  ///< m
  double fronts = 0;            ///< fronts that have passed the origin
  double turnover = 0;          ///< m
};

/// Wind on a lattice. Every eighth of a second the mean, its fronts and its large eddies are evaluated at each node;
/// between two such moments they are interpolated, and the evaluation of the next one is spread over the steps. Small
/// eddies and fans are added at each place that asks (windAt). The result depends on the time and the anchor alone.
/// Memory is taken when it is made, when the settings change and when foliage is set, never in a step.
class WindField {
 public:
  /// Covers lower..upper (m, world).
  WindField(const vec3& lower, const vec3& upper, const WindSettings& settings, int threads);

  /// What shelters what stands behind it; in the rest pose.
  void setFoliage(std::span<const Foliage> foliage);
  /// Changes the wind from `time` on; eddies and fronts go on from where they are.
  void set(const WindSettings& settings, double time);
  const WindSettings& settings() const { return settings_; }
  /// A hand on a link, part of every view from now on.
  void setPull(const LinkPull& pull) { pull_ = pull; }

  /// Brings the lattice to `time`, s.
  void advance(double time);
  WindView view() const;

  /// The field itself at any place and time, m/s; without shelter.
  vec3 velocity(const vec3& place, double time) const;
  WindMoment moment(double time) const;
  /// Mean speed at 10 m height, m/s, and the horizontal unit vector that it blows to, as a solver's constants should
  /// take them: of a wind that follows a course they change once a second at most, and by a quarter or 22.5 degrees at
  /// least. 0 once it is calm.
  float level(double time) const;
  vec3 direction(double time) const;

  const WindAnchor& anchor() const { return anchor_; }
  /// Puts a saved anchor back; the lattice follows with the next `advance`.
  void restore(const WindAnchor& anchor);

 private:
  struct Paths {
    double drift[3], fronts, turnover;
  };
  Paths pathsAt(double time) const;
  WindView viewAt(double time) const;
  void evaluate(std::vector<vec4>& nodes, std::int64_t key, std::size_t begin, std::size_t end) const;

  WindSettings settings_;
  WindTimeline timeline_;
  std::shared_ptr<const std::vector<vec4>> tile_;
  WindAnchor anchor_;
  ShelterMap shelter_;
  LinkPull pull_;
  int threads_;
  int nx_ = 0, ny_ = 0, nz_ = 0;
  vec3 origin_{0}, spacing_{1};
  std::vector<vec4> now_, first_, second_, third_;
  std::int64_t key_ = 0;  ///< first_ is key_, second_ key_ + 1, third_ key_ + 2
  double time_ = 0;       ///< of now_
  bool valid_ = false;
  std::size_t prepared_ = 0;  ///< nodes of third_ that are done
};

}  // namespace windfall::sim
