#include "kernels/wind_loops.h"

#include "kernels/targets.h"

namespace windfall {

WINDFALL_TARGETS void windRange(const WindMoment& wind, const WindLattice& lattice, std::size_t begin, std::size_t end,
                                vec4* nodes) {
  const std::size_t nx = static_cast<std::size_t>(lattice.nx), ny = static_cast<std::size_t>(lattice.ny);
  std::size_t row = static_cast<std::size_t>(-1);
  float profile = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t x = i % nx, y = i / nx % ny, z = i / (nx * ny);
    const vec3 index(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
    const vec3 place = lattice.origin + index * lattice.spacing;
    if (i / nx != row) {
      row = i / nx;
      profile = windProfile(place.y, wind.canopy);
    }
    nodes[i] = windNode(wind, place, profile);
  }
}

}  // namespace windfall
