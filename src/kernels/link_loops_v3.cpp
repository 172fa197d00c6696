// For machines with AVX2 (x86-64-v3).
#include "kernels/link_loops_body.h"

namespace windfall {
extern const LinkLoops kAvx2LinkLoops;
const LinkLoops kAvx2LinkLoops{"x86-64-v3", kCoupledPasses, kModalPasses, kAxisPasses, kForcesPasses, airPass};
}  // namespace windfall
