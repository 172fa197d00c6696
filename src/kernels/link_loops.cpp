#include "kernels/link_loops.h"

namespace windfall {

extern const LinkLoops kPlainLinkLoops;
#if defined(WINDFALL_X86_LOOPS)
extern const LinkLoops kAvx2LinkLoops, kAvx512LinkLoops;
#endif

LinkLoopsList everyLinkLoops() {
  LinkLoopsList list{{&kPlainLinkLoops, nullptr, nullptr}, 1};
#if defined(WINDFALL_X86_LOOPS)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2")) list.all[list.count++] = &kAvx2LinkLoops;
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512cd")) {
    list.all[list.count++] = &kAvx512LinkLoops;
  }
#endif
  return list;
}

const LinkLoops& linkLoops() {
  static const LinkLoopsList list = everyLinkLoops();
  return *list.all[list.count - 1];
}

}  // namespace windfall
