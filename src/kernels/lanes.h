// Several single precision numbers side by side in one register of the CPU. The arithmetic of a link is written once
// for any number type (link_algebra.h); with `float` it runs on the GPU, with `Lanes` on the CPU, with `double` in
// tests.
#pragma once

#include <cstdint>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace windfall {

// How many fit into a register of the instruction set that this file is compiled for.
#if defined(__AVX512F__)
#define WINDFALL_LANES lanes512
inline constexpr int kNativeLanes = 16;
#elif defined(__AVX2__)
#define WINDFALL_LANES lanes256
inline constexpr int kNativeLanes = 8;
#else
#define WINDFALL_LANES lanes128
inline constexpr int kNativeLanes = 4;
#endif

#define WINDFALL_INLINE inline __attribute__((always_inline))

// A namespace for each instruction set: code of one never stands in for that of another.
inline namespace WINDFALL_LANES {

using LaneFloats = float __attribute__((vector_size(kNativeLanes * 4)));
using LaneInts = std::int32_t __attribute__((vector_size(kNativeLanes * 4)));
using LaneBits = std::uint32_t __attribute__((vector_size(kNativeLanes * 4)));

/// Result of a comparison.
struct LaneMask {
  LaneInts v;
};

struct Lanes {
  LaneFloats v;
  Lanes() = default;
  WINDFALL_INLINE Lanes(float x) : v(x - LaneFloats{}) {}
  WINDFALL_INLINE explicit Lanes(LaneFloats x) : v(x) {}
  WINDFALL_INLINE static Lanes load(const float* p) {
    LaneFloats x;
    __builtin_memcpy(&x, p, sizeof x);
    return Lanes(x);
  }
  WINDFALL_INLINE void store(float* p) const { __builtin_memcpy(p, &v, sizeof v); }
  WINDFALL_INLINE Lanes& operator+=(const Lanes& b) {
    v += b.v;
    return *this;
  }
};

WINDFALL_INLINE Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.v + b.v); }
WINDFALL_INLINE Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.v - b.v); }
WINDFALL_INLINE Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.v * b.v); }
WINDFALL_INLINE Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.v / b.v); }
WINDFALL_INLINE Lanes operator-(const Lanes& a) { return Lanes(-a.v); }
WINDFALL_INLINE LaneMask operator<(const Lanes& a, const Lanes& b) { return {a.v < b.v}; }
WINDFALL_INLINE LaneMask operator>(const Lanes& a, const Lanes& b) { return {a.v > b.v}; }
WINDFALL_INLINE LaneMask operator<=(const Lanes& a, const Lanes& b) { return {a.v <= b.v}; }
WINDFALL_INLINE Lanes select(const LaneMask& m, const Lanes& a, const Lanes& b) { return Lanes(m.v ? a.v : b.v); }
WINDFALL_INLINE LaneBits bitsOf(const Lanes& a) {
  LaneBits b;
  __builtin_memcpy(&b, &a.v, sizeof b);
  return b;
}
WINDFALL_INLINE Lanes floatLike(const Lanes&, const LaneBits& b) {
  Lanes a;
  __builtin_memcpy(&a.v, &b, sizeof b);
  return a;
}

WINDFALL_INLINE Lanes squareRoot(const Lanes& a) {
#if defined(__AVX512F__)
  return Lanes(LaneFloats(_mm512_maskz_sqrt_ps(0xffff, __m512(a.v))));
#elif defined(__AVX2__)
  return Lanes(LaneFloats(_mm256_sqrt_ps(__m256(a.v))));
#elif defined(__SSE2__)
  return Lanes(LaneFloats(_mm_sqrt_ps(__m128(a.v))));
#else
  Lanes r;
  for (int i = 0; i < kNativeLanes; ++i) r.v[i] = __builtin_sqrtf(a.v[i]);
  return r;
#endif
}

/// Lanes of the lower halves of a and b, taken in turns.
WINDFALL_INLINE Lanes interleaveLow(const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
  return Lanes(__builtin_shufflevector(a.v, b.v, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23));
#elif defined(__AVX2__)
  return Lanes(__builtin_shufflevector(a.v, b.v, 0, 8, 1, 9, 2, 10, 3, 11));
#else
  return Lanes(__builtin_shufflevector(a.v, b.v, 0, 4, 1, 5));
#endif
}

/// The same of the upper halves.
WINDFALL_INLINE Lanes interleaveHigh(const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
  return Lanes(__builtin_shufflevector(a.v, b.v, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31));
#elif defined(__AVX2__)
  return Lanes(__builtin_shufflevector(a.v, b.v, 4, 12, 5, 13, 6, 14, 7, 15));
#else
  return Lanes(__builtin_shufflevector(a.v, b.v, 2, 6, 3, 7));
#endif
}

/// As many registers as lanes: lane j of register i changes places with lane i of register j.
WINDFALL_INLINE void transpose(Lanes (&m)[kNativeLanes]) {
  // Each round interleaves the two halves; after as many rounds as the count has binary digits all are in place.
  for (int round = 1; round < kNativeLanes; round *= 2) {
    Lanes next[kNativeLanes];
    for (int i = 0; i < kNativeLanes / 2; ++i) {
      next[2 * i] = interleaveLow(m[i], m[i + kNativeLanes / 2]);
      next[2 * i + 1] = interleaveHigh(m[i], m[i + kNativeLanes / 2]);
    }
    for (int i = 0; i < kNativeLanes; ++i) m[i] = next[i];
  }
}

}  // namespace WINDFALL_LANES
}  // namespace windfall
