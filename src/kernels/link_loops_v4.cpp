// For machines with AVX-512 (x86-64-v4).
#include "kernels/link_loops_body.h"

namespace windfall {
extern const LinkLoops kAvx512LinkLoops;
const LinkLoops kAvx512LinkLoops{"x86-64-v4", kCoupledPasses, kModalPasses, kAxisPasses, kForcesPasses, airPass};
}  // namespace windfall
