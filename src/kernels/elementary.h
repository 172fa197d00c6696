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

/// The bits as a number of the kind of the first argument.
WINDFALL_HD float floatLike(float, std::uint32_t bits) { return floatOf(bits); }

WINDFALL_HD float select(bool condition, float a, float b) { return condition ? a : b; }
WINDFALL_HD double select(bool condition, double a, double b) { return condition ? a : b; }

/// Adding this number rounds to the nearest integer, which then stands in the low bits; |x| < 2^22.
inline constexpr float kRounder = 12582912.0f;

template <class R>
struct SinCosOf {
  R sin, cos;
};
using SinCos = SinCosOf<float>;

/// Sine and cosine of an angle in turns (1 = 360 degrees), |turns| < 2^20; error below 1.5e-7 beside that of the
/// argument. Polynomials of Cephes (Moshier) on an eighth of a turn. R: float, or several side by side (lanes.h).
template <class R>
WINDFALL_HD SinCosOf<R> sinCosTurns(R turns) {
  const R shifted = turns * R(4.0f) + R(kRounder);
  const auto quarter = bitsOf(shifted);
  const R x = (turns - (shifted - R(kRounder)) * R(0.25f)) * R(6.28318530718f);
  const R x2 = x * x;
  const R s = x + x * x2 * (R(-1.6666654611e-1f) + x2 * (R(8.3321608736e-3f) - x2 * R(1.9515295891e-4f)));
  const R c = R(1.0f) - R(0.5f) * x2 +
              x2 * x2 * (R(4.166664568298827e-2f) + x2 * (R(-1.388731625493765e-3f) + x2 * R(2.443315711809948e-5f)));
  const auto swap = 0u - (quarter & 1u);
  const auto a = bitsOf(s), b = bitsOf(c);
  const auto sine = (a & ~swap) | (b & swap);
  const auto cosine = (b & ~swap) | (a & swap);
  return {floatLike(x, sine ^ ((quarter & 2u) << 30u)), floatLike(x, cosine ^ (((quarter + 1u) & 2u) << 30u))};
}

/// e^x for -87 <= x <= 87 (clamped there); relative error below 3e-7.
template <class R>
WINDFALL_HD R expOf(R x) {
  const R low = select(x > R(-87.0f), x, R(-87.0f));
  const R y = select(low < R(87.0f), low, R(87.0f));
  const R shifted = y * R(1.44269504089f) + R(kRounder);
  const R whole = shifted - R(kRounder);
  // ln 2 in two pieces: the first product is exact.
  const R f = (y - whole * R(0.693359375f)) + whole * R(2.12194440e-4f);
  const R p =
      R(1.0f) +
      f * (R(1.0f) + f * (R(0.5f) + f * (R(1.6666667e-1f) +
                                         f * (R(4.1666598e-2f) + f * (R(8.3334519e-3f) + f * R(1.3942973e-3f))))));
  return p * floatLike(x, (bitsOf(shifted) - bitsOf(R(kRounder)) + 127u) << 23u);
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
