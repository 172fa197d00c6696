#include "kernels/wind_lookup.h"

#include <doctest/doctest.h>

#include <cstring>
#include <limits>
#include <vector>

#include "kernels/random.h"

using namespace windfall;

TEST_CASE("the links' lookup of the wind has the bits of the plain one, wherever it looks") {
  std::vector<vec4> nodes, tile;
  for (std::uint32_t i = 0; i < 5 * 4 * 3; ++i) {
    nodes.emplace_back(uniform(1, i) * 9, uniform(2, i) - 0.5f, uniform(3, i), uniform(4, i) - 0.2f);
  }
  for (std::uint32_t i = 0; i < kTileNodes; ++i) {
    tile.emplace_back(uniform(5, i) - 0.5f, uniform(6, i) - 0.5f, uniform(7, i) - 0.5f, 0);
  }
  WindView wind;
  wind.velocity = nodes.data();
  wind.nx = 5, wind.ny = 4, wind.nz = 3;
  wind.origin = vec3(-4, 0, -2);
  wind.perMetre = vec3(0.5f, 0.4f, 0.7f);
  wind.eddies = tile.data();
  wind.eddyScroll = vec3(3.3f, 60.1f, 1.7f);
  wind.fanCount = 1;
  wind.fans[0].speed = 6;
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  std::vector<vec3> places{vec3(nan), vec3(infinity), vec3(-infinity, 1, nan), vec3(1e6f), vec3(-1e30f, 3, 1), vec3(0)};
  for (std::uint32_t i = 0; i < 2000; ++i) {
    places.push_back(vec3(uniform(8, i), uniform(9, i), uniform(10, i)) * 40.f - vec3(20, 5, 20));
  }
  const auto same = [&] {
    int different = 0;
    for (const vec3& place : places) {
      const vec3 a = windAt(wind, place), b = airAt(wind, place);
      different += std::memcmp(&a, &b, sizeof a) != 0 ? 1 : 0;
    }
    return different == 0;
  };
  CHECK(same());
  wind.eddies = nullptr;
  CHECK(same());
  wind.velocity = nullptr;
  CHECK(same());
}
