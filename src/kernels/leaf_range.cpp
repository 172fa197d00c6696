#include "kernels/leaf_range.h"

#include "kernels/leaf_step.h"

namespace windfall {

namespace {

// Inlined whole into each of the functions below, which differ in their instruction set only.
inline void stepRange(const LeafArrays& arrays, std::uint32_t begin, std::uint32_t end, const LeafStep& shared) {
  // Copies on the stack, which no store through a pointer of the arrays can change.
  const LeafArrays a = arrays;
  const LeafStep step = shared;
  for (std::uint32_t first = begin; first < end; first += kLeafBlock) {
    const std::uint32_t last = first + kLeafBlock < end ? first + kLeafBlock : end;
    if ((first / kLeafBlock + step.number) % step.interval == 0) {
      for (std::uint32_t i = first; i < last; ++i) lookAround(a, i, step);
    }
    std::uint32_t hanging = 0, falling = 0, sliding = 0;
    for (std::uint32_t i = first; i < last; ++i) {
      const std::uint32_t state = a.meta[i] & kStateMask;
      hanging += state == static_cast<std::uint32_t>(LeafState::Attached) ? 1u : 0u;
      falling += state == static_cast<std::uint32_t>(LeafState::Falling) ? 1u : 0u;
      sliding += state == static_cast<std::uint32_t>(LeafState::Sliding) ? 1u : 0u;
    }
    std::uint32_t due[kLeafBlock];
    std::uint32_t rare = 0;
    if (falling > 0) {
#pragma omp simd reduction(+ : rare)
      for (std::size_t i = first; i < last; ++i) {
        const std::uint32_t is = moveLeaf(a, i, step) ? 1u : 0u;
        due[i - first] = is;
        rare += is;
      }
    } else if (hanging > 0) {
#pragma omp simd
      for (std::size_t i = first; i < last; ++i) hangLeaf(a, i, step);
    }
    if (sliding > 0) {
      for (std::uint32_t i = first; i < last; ++i) {
        if (stateOf(a.meta[i]) == LeafState::Sliding) slide(a, i, step);
      }
    }
    if (rare > 0) {
      for (std::uint32_t i = first; i < last; ++i) {
        if (due[i - first] != 0) turnPage(a, i, step);
      }
    }
  }
}

// Sanitizers check one version: four would take minutes to compile.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(WINDFALL_SANITIZED)
#define WINDFALL_LEVELS
#endif

#if defined(WINDFALL_LEVELS)
#define WINDFALL_LEVEL(name, arch)                                                                        \
  __attribute__((target("arch=" arch), flatten)) void name(const LeafArrays& arrays, std::uint32_t begin, \
                                                           std::uint32_t end, const LeafStep& step) {     \
    stepRange(arrays, begin, end, step);                                                                  \
  }
WINDFALL_LEVEL(stepLevel2, "x86-64-v2")
WINDFALL_LEVEL(stepLevel3, "x86-64-v3")
WINDFALL_LEVEL(stepLevel4, "x86-64-v4")
#undef WINDFALL_LEVEL
#endif

void stepPlain(const LeafArrays& arrays, std::uint32_t begin, std::uint32_t end, const LeafStep& step) {
  stepRange(arrays, begin, end, step);
}

}  // namespace

#if defined(WINDFALL_LEVELS)
int bestLevel() {
  if (__builtin_cpu_supports("x86-64-v4")) return 4;
  if (__builtin_cpu_supports("x86-64-v3")) return 3;
  return __builtin_cpu_supports("x86-64-v2") ? 2 : 0;
}

LeafRange leafRange(int level) {
  if (level > bestLevel()) return nullptr;
  return level == 4 ? stepLevel4 : level == 3 ? stepLevel3 : level == 2 ? stepLevel2 : level == 0 ? stepPlain : nullptr;
}
#else
int bestLevel() { return 0; }
LeafRange leafRange(int level) { return level == 0 ? stepPlain : nullptr; }
#endif

}  // namespace windfall
