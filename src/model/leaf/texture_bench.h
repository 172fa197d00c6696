// Benchmarks of making textures from leaf photographs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/leaf/stages.h"
#include "sim/bench.h"

namespace windfall::model {

/// Somebody else's SLIC: about `count` superpixels of the distance. Empty `run`: it is not there, as `name` tells.
struct SlicPeer {
  std::string name;  ///< "OpenCV's SLIC"
  std::function<void(const ScalarField& distance, int count)> run;
};

/// A leaf from its photo to a texture, and the stages of the way that differ from the thesis's, beside those. With
/// peers the thesis's way is also timed with theirs.
std::vector<sim::Benchmark> textureBenchmarks(const std::vector<SlicPeer>& peers = {});

}  // namespace windfall::model
