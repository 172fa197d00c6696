// The choice of runs on the CPU: the reference of the compute shaders, and the faster way where those run in software.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kernels/detail_select.h"

namespace windfall::render {

/// A tree with an adaptive mesh, and where its share of the common arrays begins.
struct DetailTree {
  std::shared_ptr<const DetailMesh> mesh;
  std::uint32_t firstLink = 0;     ///< of the bone buffer
  std::uint32_t firstSkinned = 0;  ///< of the skinned rings
  std::uint32_t firstKey = 0;      ///< of the entries of all trees
  std::uint32_t layer = 0;         ///< of the barks
};

class DetailSelector {
 public:
  void setTrees(std::vector<DetailTree> trees);
  /// Writes the rings that are used, and the runs grid by grid in the order of trees and entries; returns how many runs
  /// each grid has. `skinned` and `runs` have room for all rings and entries of all trees. Parallel over blocks of
  /// chains; the same result for any number of threads. Allocates nothing once it has been through a scene's finest.
  std::array<std::uint32_t, kDetailGrids> select(const DetailCamera& camera, std::span<const mat4> bones,
                                                 std::span<SkinnedRing> skinned, std::span<DetailRun> runs);

 private:
  struct Chosen {
    DetailRun run;
    std::uint32_t grid = 0;
  };
  struct Block {
    std::uint32_t tree = 0, firstChain = 0, endChain = 0;
    std::vector<Chosen> chosen;
    std::array<std::uint32_t, kDetailGrids> counts{};
  };
  void selectBlock(Block& block, const DetailCamera& camera, std::span<const mat4> bones,
                   std::span<SkinnedRing> skinned);

  std::vector<DetailTree> trees_;
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> stamps_;  ///< of each ring: the last selection that has skinned it
  std::uint32_t stamp_ = 0;
};

}  // namespace windfall::render
