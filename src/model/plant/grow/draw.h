// Random numbers of the growers: a function of the seed, of who asks and of the question (growers.md, introduction).
#pragma once

#include <cstdint>

namespace windfall::model::growth {

/// The splitmix64 finaliser (Steele, Lea, Flood 2014).
constexpr std::uint64_t mix(std::uint64_t z) {
  z += 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30u)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27u)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31u);
}

/// 0 <= u < 1 from 64 bits.
constexpr double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11u) * 0x1p-53; }

/// The answer to `question` for the thing `who`: no order and no thread count changes it.
constexpr double draw(std::uint64_t seed, std::uint64_t who, std::uint64_t question) {
  return unit(mix(mix(mix(seed) ^ who) ^ question));
}

}  // namespace windfall::model::growth
