// What the gallery says about a leaf's variants.
#pragma once

#include <span>
#include <vector>

#include "model/leaf/leaf.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model {

struct VariantScore {
  double quality = 0;    ///< Q, 0..100 (quality.h)
  double copyIndex = 0;  ///< -1..1; 0.9 and more: the photo itself
  double diversity = 0;  ///< CIE76 to the variant before, for the first to the second; 0 where there is only one
};

/// Scores the leaf's variants beside what lent them its colours (`lenders` in the order of Leaf::examples; none: the
/// leaf itself), at 512 px and by the shapes and veins that its parameters give now. One entry a variant; an error when
/// cancelled or when a photo shows no leaf.
Result<std::vector<VariantScore>> scoreVariants(const Leaf& leaf, std::span<const Leaf> lenders, Progress& progress);

}  // namespace windfall::model
