#include "model/plant/mesh_pieces.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace windfall::model {

namespace {

/// Union-find. The smaller index leads, so the result does not depend on the order of joining.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

MeshPieces connectedPieces(const PlantGeometry& geometry, const MeshPart& part) {
  const auto place = [&](std::uint32_t corner) {
    const vec3& p = geometry.vertices[geometry.indices[part.firstIndex + corner]].position;
    return std::tie(p.x, p.y, p.z);
  };
  std::vector<std::uint32_t> byPlace(part.indexCount), welded(part.indexCount);
  std::iota(byPlace.begin(), byPlace.end(), 0u);
  std::sort(byPlace.begin(), byPlace.end(), [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
  std::uint32_t places = 0;
  for (std::size_t i = 0; i < byPlace.size(); ++i) {
    if (i > 0 && place(byPlace[i - 1]) != place(byPlace[i])) ++places;
    welded[byPlace[i]] = places;
  }
  Sets sets(places + 1);
  for (std::uint32_t i = 0; i + 2 < part.indexCount; i += 3) {
    sets.join(welded[i], welded[i + 1]);
    sets.join(welded[i], welded[i + 2]);
  }
  MeshPieces pieces;
  constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> number(places + 1, kNone);
  for (std::uint32_t i = 0; i + 2 < part.indexCount; i += 3) {
    std::uint32_t& piece = number[sets.root(welded[i])];
    if (piece == kNone) piece = pieces.count++;
    pieces.ofTriangle.push_back(piece);
  }
  return pieces;
}

}  // namespace windfall::model
