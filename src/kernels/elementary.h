// Sine, cosine and exponential as short polynomials: the same bits on every instruction set and device, and loops over
// them vectorise, which calls of the C library do not.
#pragma once

#include <bit>
#include <cstdint>

#include "kernels/math.h"

namespace windfall {

WINDFALL_HD std::uint32_t bitsOf(float value) {
#if defined(__CUDA_ARCH__)
  return __float_as_uint(value);
#else
  return std::bit_cast<std::uint32_t>(value);
#endif
}

WINDFALL_HD float floatOf(std::uint32_t bits) {
#if defined(__CUDA_ARCH__)
  return __uint_as_float(bits);
#else
  return std::bit_cast<float>(bits);
#endif
}

/// Adding this number rounds to the nearest integer, which then stands in the low bits; |x| < 2^22.
inline constexpr float kRounder = 12582912.0f;

struct SinCos {
  float sin, cos;
};

/// Sine and cosine of an angle in turns (1 = 360 degrees), |turns| < 2^20; error below 1.5e-7 beside that of the
/// argument. Polynomials of Cephes (Moshier) on an eighth of a turn.
WINDFALL_HD SinCos sinCosTurns(float turns) {
  const float shifted = turns * 4.0f + kRounder;
  const std::uint32_t quarter = bitsOf(shifted);
  const float x = (turns - (shifted - kRounder) * 0.25f) * 6.28318530718f;
  const float x2 = x * x;
  const float s = x + x * x2 * (-1.6666654611e-1f + x2 * (8.3321608736e-3f - x2 * 1.9515295891e-4f));
  const float c =
      1.0f - 0.5f * x2 + x2 * x2 * (4.166664568298827e-2f + x2 * (-1.388731625493765e-3f + x2 * 2.443315711809948e-5f));
  const std::uint32_t swap = 0u - (quarter & 1u);
  const std::uint32_t a = bitsOf(s), b = bitsOf(c);
  const std::uint32_t sine = (a & ~swap) | (b & swap);
  const std::uint32_t cosine = (b & ~swap) | (a & swap);
  return {floatOf(sine ^ ((quarter & 2u) << 30u)), floatOf(cosine ^ (((quarter + 1u) & 2u) << 30u))};
}

/// e^x for -87 <= x <= 87 (clamped there); relative error below 3e-7.
WINDFALL_HD float expOf(float x) {
  const float low = x > -87.0f ? x : -87.0f;
  const float y = low < 87.0f ? low : 87.0f;
  const float shifted = y * 1.44269504089f + kRounder;
  const float whole = shifted - kRounder;
  // ln 2 in two pieces: the first product is exact.
  const float f = (y - whole * 0.693359375f) + whole * 2.12194440e-4f;
  const float p =
      1.0f +
      f * (1.0f + f * (0.5f + f * (1.6666667e-1f + f * (4.1666598e-2f + f * (8.3334519e-3f + f * 1.3942973e-3f)))));
  return p * floatOf((bitsOf(shifted) - bitsOf(kRounder) + 127u) << 23u);
}

/// tanh(x) for x >= 0.
WINDFALL_HD float tanhOf(float x) {
  const float e = expOf(-2.0f * x);
  return (1.0f - e) / (1.0f + e);
}

/// 3 w^2 - 2 w^3 with w clamped to 0..1.
WINDFALL_HD float smoothStep(float w) {
  const float low = w > 0.0f ? w : 0.0f;
  const float x = low < 1.0f ? low : 1.0f;
  return x * x * (3.0f - 2.0f * x);
}

}  // namespace windfall
