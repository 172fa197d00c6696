// Threads of air that show the wind: drawn by the renderer, no part of the simulation's state.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/wind.h"

namespace windfall::sim {

/// Particles that the wind carries, each with the way it came. The same steps give the same bits.
class WindStreaks {
 public:
  static constexpr int kPoints = 16;  ///< of a streak, the newest first

  explicit WindStreaks(std::uint32_t count = 220);

  /// `seconds` on, in the wind as it is; streaks that leave the box of the wind's lattice or grow old begin elsewhere.
  void advance(double seconds, const WindView& wind);
  void clear();
  /// kPoints a streak: world place, and in w how much of it is seen, 0..1.
  std::span<const vec4> points() const { return points_; }

 private:
  struct Streak {
    float age = 0, life = 0;  ///< s
    std::uint32_t births = 0;
  };
  void begin(std::uint32_t index, const WindView& wind);
  void move(float h, const WindView& wind);

  std::vector<Streak> streaks_;
  std::vector<vec4> points_;
  double left_ = 0;  ///< s not yet made up by whole steps
};

}  // namespace windfall::sim
