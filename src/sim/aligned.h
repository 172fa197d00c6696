// Arrays that begin on a cache line; large ones on a large page, where the system has them.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace windfall::sim {

template <class T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}

  static constexpr std::size_t kPage = std::size_t{2} << 20u;
  static std::align_val_t alignmentOf(std::size_t count) {
    return std::align_val_t{count * sizeof(T) >= kPage ? kPage : std::size_t{64}};
  }
  T* allocate(std::size_t count) {
    void* memory = ::operator new(count * sizeof(T), alignmentOf(count));
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (count * sizeof(T) >= kPage) madvise(memory, count * sizeof(T), MADV_HUGEPAGE);
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) { ::operator delete(memory, alignmentOf(count)); }
  bool operator==(const AlignedAllocator&) const { return true; }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace windfall::sim
