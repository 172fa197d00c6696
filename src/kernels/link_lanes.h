// Rows of links into lanes and back: a transposition in registers. Only for link_loops_body.h.
#pragma once

#include "kernels/lanes.h"
#include "kernels/link_slots.h"

namespace windfall {
inline namespace WINDFALL_LANES {

/// The fields of as many neighbouring slots of a block as there are lanes.
struct LaneFields {
  float* first;
  WINDFALL_INLINE Lanes get(std::uint32_t field) const { return Lanes::load(first + field * kSlotBlock); }
  WINDFALL_INLINE void put(std::uint32_t field, const Lanes& value) const { value.store(first + field * kSlotBlock); }
};
struct LaneConstants {
  const float* first;
  WINDFALL_INLINE Lanes get(std::uint32_t field) const { return Lanes::load(first + field * kSlotBlock); }
};

#if defined(__AVX512F__)
using HalfFloats = float __attribute__((vector_size(32)));

WINDFALL_INLINE HalfFloats loadHalf(const float* p) {
  HalfFloats x;
  __builtin_memcpy(&x, p, sizeof x);
  return x;
}
WINDFALL_INLINE Lanes joined(const HalfFloats& low, const HalfFloats& high) {
  return Lanes(__builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
}
WINDFALL_INLINE HalfFloats lowHalf(const Lanes& a) { return __builtin_shufflevector(a.v, a.v, 0, 1, 2, 3, 4, 5, 6, 7); }
WINDFALL_INLINE HalfFloats highHalf(const Lanes& a) {
  return __builtin_shufflevector(a.v, a.v, 8, 9, 10, 11, 12, 13, 14, 15);
}

/// Transposes both halves of eight registers as squares of eight.
WINDFALL_INLINE void transposeHalves(Lanes (&m)[8]) {
  for (int round = 1; round < 8; round *= 2) {
    Lanes next[8];
    for (int i = 0; i < 4; ++i) {
      next[2 * i] =
          Lanes(__builtin_shufflevector(m[i].v, m[i + 4].v, 0, 16, 1, 17, 2, 18, 3, 19, 8, 24, 9, 25, 10, 26, 11, 27));
      next[2 * i + 1] = Lanes(
          __builtin_shufflevector(m[i].v, m[i + 4].v, 4, 20, 5, 21, 6, 22, 7, 23, 12, 28, 13, 29, 14, 30, 15, 31));
    }
    for (int i = 0; i < 8; ++i) m[i] = next[i];
  }
}
#endif

/// Rows of `Length` numbers, one for each lane at `index`, as `Length` fields; and back.
template <std::uint32_t Length>
struct Rows {
  Lanes field[Length];

  /// Reads the rows; `Clear` leaves zeros in them.
  template <bool Clear, class T>
  WINDFALL_INLINE void read(T* rows, const std::uint32_t* index) {
#if defined(__AVX512F__)
    if constexpr (Length == 8) {
      Lanes m[8];
      for (int j = 0; j < 8; ++j) {
        T *a = rows + std::size_t{index[j]} * 8, *b = rows + std::size_t{index[j + 8]} * 8;
        m[j] = joined(loadHalf(a), loadHalf(b));
        if constexpr (Clear) {
          const HalfFloats zero{};
          __builtin_memcpy(a, &zero, sizeof zero);
          __builtin_memcpy(b, &zero, sizeof zero);
        }
      }
      transposeHalves(m);
      for (int f = 0; f < 8; ++f) field[f] = m[f];
      return;
    }
#endif
    for (std::uint32_t chunk = 0; chunk < Length; chunk += kNativeLanes) {
      Lanes m[kNativeLanes];
      for (int j = 0; j < kNativeLanes; ++j) {
        T* row = rows + std::size_t{index[j]} * Length + chunk;
        m[j] = Lanes::load(row);
        if constexpr (Clear) Lanes(0.0f).store(row);
      }
      transpose(m);
      for (int f = 0; f < kNativeLanes && chunk + f < Length; ++f) field[chunk + f] = m[f];
    }
  }

  /// Writes the rows, or adds to them from the last lane to the first.
  template <bool Add>
  WINDFALL_INLINE void write(float* rows, const std::uint32_t* index) const {
#if defined(__AVX512F__)
    if constexpr (Length == 8) {
      Lanes m[8];
      for (int f = 0; f < 8; ++f) m[f] = field[f];
      transposeHalves(m);
      for (int j = 15; j >= 0; --j) {
        float* row = rows + std::size_t{index[j]} * 8;
        HalfFloats x = j < 8 ? lowHalf(m[j % 8]) : highHalf(m[j % 8]);
        if constexpr (Add) x += loadHalf(row);
        __builtin_memcpy(row, &x, sizeof x);
      }
      return;
    }
#endif
    for (std::uint32_t chunk = 0; chunk < Length; chunk += kNativeLanes) {
      Lanes m[kNativeLanes];
      for (int f = 0; f < kNativeLanes; ++f) m[f] = chunk + f < Length ? field[chunk + f] : Lanes(0.0f);
      transpose(m);
      for (int j = kNativeLanes - 1; j >= 0; --j) {
        float* row = rows + std::size_t{index[j]} * Length + chunk;
        if constexpr (Add) m[j] += Lanes::load(row);
        m[j].store(row);
      }
    }
  }
};

}  // namespace WINDFALL_LANES
}  // namespace windfall
