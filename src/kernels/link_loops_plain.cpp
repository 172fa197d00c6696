// For any machine; on x86-64 with SSE2.
#include "kernels/link_loops_body.h"

namespace windfall {
extern const LinkLoops kPlainLinkLoops;
const LinkLoops kPlainLinkLoops{"plain", kCoupledPasses, kModalPasses, kAxisPasses, kForcesPasses, airPass};
}  // namespace windfall
