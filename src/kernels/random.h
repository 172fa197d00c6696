// Counter-based random numbers: a value is a function of its seed and its counters, the same on every device, in any
// order.
#pragma once

#include <cmath>
#include <cstdint>

#include "kernels/math.h"

namespace windfall {

/// PCG-RXS-M-XS, 32 bits in and out (Jarzynski & Olano 2020, Hash Functions for GPU Rendering).
WINDFALL_HD std::uint32_t pcg(std::uint32_t value) {
  const std::uint32_t state = value * 747796405u + 2891336453u;
  const std::uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

/// Hash of a 64-bit seed and up to three counters.
WINDFALL_HD std::uint32_t hash(std::uint64_t seed, std::uint32_t a, std::uint32_t b = 0, std::uint32_t c = 0) {
  std::uint32_t h = pcg(static_cast<std::uint32_t>(seed) ^ 0x9e3779b9u);
  h = pcg(h ^ static_cast<std::uint32_t>(seed >> 32u));
  h = pcg(h ^ a);
  h = pcg(h ^ b);
  return pcg(h ^ c);
}

/// 0 <= u < 1 with 24 bits.
WINDFALL_HD float uniform(std::uint32_t bits) { return static_cast<float>(bits >> 8u) * (1.0f / 16777216.0f); }

WINDFALL_HD float uniform(std::uint64_t seed, std::uint32_t a, std::uint32_t b = 0, std::uint32_t c = 0) {
  return uniform(hash(seed, a, b, c));
}

/// A sequence for host code that draws one number after the other.
class RandomSequence {
 public:
  explicit RandomSequence(std::uint64_t seed, std::uint32_t stream = 0) : seed_(seed), stream_(stream) {}
  std::uint32_t bits() { return hash(seed_, stream_, counter_++); }
  /// 0 <= u < 1.
  double uniform() { return bits() * (1.0 / 4294967296.0); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// 0 .. count - 1.
  std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(bits()) * count) >> 32u);
  }
  /// Standard normal by Box and Muller.
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(6.283185307179586 * uniform());
  }

 private:
  std::uint64_t seed_;
  std::uint32_t stream_, counter_ = 0;
};

}  // namespace windfall
