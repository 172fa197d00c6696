// Leaves of one mask that lie apart or touch; private to model.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace windfall::model {

/// The leaves that a mask (255 leaf) shows, one mask of its size each, largest first: parts that lie apart, of at least
/// `leastShare` of the largest one's area, and parts that touch. Those are cut where the outline has a narrow neck
/// between two compact parts, found by the distance to the margin. A lobed or a compound leaf stays whole: its parts
/// are not compact, meet at their ends, or are joined by a stalk; where any neck is in doubt none is cut. One leaf: the
/// mask itself, with all its crumbs.
std::vector<cv::Mat1b> leavesOf(const cv::Mat1b& mask, double leastShare);

}  // namespace windfall::model
