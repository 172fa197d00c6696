// windfall bench --filter plant.foliage: a forest far off, with every leaf and with cards of clusters.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/result.h"

namespace windfall::app {

/// A way to draw the forest, from one distance.
struct FoliageRow {
  std::string contender;
  double distance = 0;           ///< m, to the nearest row of trees
  double least = 0, median = 0;  ///< ms a frame
  double difference = 0;         ///< mean of blocks of 16 px from the picture with every leaf and no budget, of 255
};

/// Fifty grown trees of five kinds, drawn in turns; `say` gets lines for people. `folder`: pictures are kept there.
Result<std::vector<FoliageRow>> benchFoliage(int rounds, const std::string& folder,
                                             const std::function<void(const std::string&)>& say);

std::string foliageJson(const FoliageRow& row);

}  // namespace windfall::app
