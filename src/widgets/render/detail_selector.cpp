#include "widgets/render/detail_selector.h"

namespace windfall::render {

namespace {

constexpr std::uint32_t kBlock = 256;  // chains

}  // namespace

void DetailSelector::setTrees(std::vector<DetailTree> trees) {
  trees_ = std::move(trees);
  blocks_.clear();
  std::size_t rings = 0;
  for (std::uint32_t t = 0; t < trees_.size(); ++t) {
    const DetailMesh& mesh = *trees_[t].mesh;
    rings = std::max(rings, trees_[t].firstSkinned + mesh.rings.size());
    std::uint32_t first = 0, highest = 0;
    for (std::uint32_t c = 0; c < mesh.chains.size(); ++c) {
      const DetailChain& chain = mesh.chains[c];
      // Pieces of one chain share a ring, so they share a block.
      bool shared = false;
      for (std::uint32_t e = 0; e < chain.entryCount; ++e) {
        shared = shared || (c > 0 && mesh.entries[chain.firstEntry + e].ringA <= highest);
      }
      if (c - first >= kBlock && !shared) blocks_.push_back({t, first, c, {}, {}}), first = c;
      for (std::uint32_t e = 0; e < chain.entryCount; ++e) {
        highest = std::max(highest, mesh.entries[chain.firstEntry + e].ringB);
      }
    }
    const auto end = static_cast<std::uint32_t>(mesh.chains.size());
    if (end > first) blocks_.push_back({t, first, end, {}, {}});
  }
  stamps_.assign(rings, 0);
  stamp_ = 0;
}

void DetailSelector::selectBlock(Block& block, const DetailCamera& camera, std::span<const mat4> bones,
                                 std::span<SkinnedRing> skinned) {
  const DetailTree& tree = trees_[block.tree];
  const DetailMesh& mesh = *tree.mesh;
  block.chosen.clear();
  block.counts = {};
  const mat4* links = bones.data() + tree.firstLink;
  const auto placeOf = [&](std::uint32_t ring) {
    return detail::moved(links[mesh.rings[ring].link], mesh.rings[ring].position);
  };
  const auto use = [&](std::uint32_t ring) {
    std::uint32_t& stamp = stamps_[tree.firstSkinned + ring];
    if (stamp == stamp_) return;
    stamp = stamp_;
    skinned[tree.firstSkinned + ring] = skinRing(mesh.rings[ring], links[mesh.rings[ring].link],
                                                 tree.firstLink | tree.layer << 24, mesh.widening, camera);
  };
  for (std::uint32_t c = block.firstChain; c < block.endChain; ++c) {
    const DetailChain& chain = mesh.chains[c];
    const vec3 centre = placeOf(chain.middle);
    if (detail::outside(camera, centre, chain.radius)) continue;
    const float centre2 = detail::square(centre - camera.eye);
    for (std::uint32_t e = chain.firstEntry; e < chain.firstEntry + chain.entryCount; ++e) {
      const DetailEntry& entry = mesh.entries[e];
      if (!detail::reaches(camera, centre2, chain.radius, entry.from) ||
          detail::reaches(camera, centre2, chain.radius, entry.to)) {
        continue;
      }
      const int grid = detail::gridOf(camera, entry, placeOf(entry.ringA), mesh.rings[entry.ringA].radius,
                                      placeOf(entry.ringB), mesh.rings[entry.ringB].radius);
      if (grid < 0) continue;
      use(entry.ringA);
      use(entry.ringB);
      block.chosen.push_back({{tree.firstSkinned + entry.ringA, tree.firstSkinned + entry.ringB, entry.shape},
                              static_cast<std::uint32_t>(grid)});
      ++block.counts[static_cast<std::size_t>(grid)];
    }
  }
}

std::array<std::uint32_t, kDetailGrids> DetailSelector::select(const DetailCamera& camera, std::span<const mat4> bones,
                                                               std::span<SkinnedRing> skinned,
                                                               std::span<DetailRun> runs) {
  ++stamp_;
  const auto count = static_cast<std::int64_t>(blocks_.size());
#pragma omp parallel for schedule(dynamic, 1) if (count > 1)
  for (std::int64_t b = 0; b < count; ++b) {
    selectBlock(blocks_[static_cast<std::size_t>(b)], camera, bones, skinned);
  }
  std::array<std::uint32_t, kDetailGrids> counts{}, next{};
  for (const Block& block : blocks_) {
    for (std::size_t g = 0; g < kDetailGrids; ++g) counts[g] += block.counts[g];
  }
  for (std::size_t g = 1; g < kDetailGrids; ++g) next[g] = next[g - 1] + counts[g - 1];
  for (const Block& block : blocks_) {
    for (const Chosen& chosen : block.chosen) runs[next[chosen.grid]++] = chosen.run;
  }
  return counts;
}

}  // namespace windfall::render
