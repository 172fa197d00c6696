// Sets of links that belong together: what the selection commands choose.
#pragma once

#include <QRectF>
#include <vector>

#include "sim/tree.h"
#include "widgets/viewport/orbit_camera.h"
#include "widgets/viewport/picking.h"

namespace windfall::widgets {

using Links = std::vector<std::size_t>;  ///< sorted, each once

/// All links of the branches that hold any of `links`.
Links wholeBranches(const sim::Tree& tree, const Links& links);
/// `links` and everything that grows out of them.
Links withChildren(const sim::Tree& tree, const Links& links);
/// The links that carry `links`, not themselves.
Links carriers(const sim::Tree& tree, const Links& links);
/// Every link of the orders low..high (0 trunk, 1 limbs, 2 and on twigs).
Links ofOrder(const sim::Tree& tree, int low, int high);
/// Every link of the same orders as `links`.
Links sameOrder(const sim::Tree& tree, const Links& links);
/// Links whose middle lies inside a rectangle of the picture.
Links insideBox(const QRectF& box, const std::vector<LinkCapsule>& capsules, const std::vector<mat4>& pose,
                const OrbitCamera& camera, QSize size);

/// First frequency of a branch with all that it carries, clamped at its base, Hz (tree_dynamics.md, 2.7).
double branchFrequency(const sim::Tree& tree, std::size_t link);

}  // namespace windfall::widgets
