// The thesis's own way through the slow stages; only to be measured against.
#pragma once

#include <cstdint>
#include <vector>

#include "model/leaf/distance.h"

namespace windfall::model {

/// Structural distance by rounds over a frontier that relaxes pixels again and again (a label-correcting search); the
/// same integers as structuralDistance.
std::vector<std::int32_t> labelCorrectingDistance(const std::vector<Tissue>& types, QSize size, QPoint source,
                                                  const DistanceCosts& costs);

/// smooth() by Gauss-Seidel sweeps in the order of the pixels.
void smoothGaussSeidel(std::vector<float>& values, const std::vector<unsigned char>& mask, QSize size, double w1,
                       int sweeps = 100);

}  // namespace windfall::model
