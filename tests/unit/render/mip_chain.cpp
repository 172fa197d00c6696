// Mip levels of cut-out leaves: coverage and colour stay.
#include "widgets/render/mip_chain.h"

#include <doctest/doctest.h>

#include "support/render_scene.h"

using namespace windfall;

TEST_CASE("every mip level covers as much as the picture itself") {
  const auto levels = render::mipChain(test::drawnLeaf(120, 200, vec3(0.8f, 0.5f, 0.1f)), 256, 256, true);
  REQUIRE(levels.size() == 9);
  const double wanted = render::coverage(levels[0]);
  CHECK(wanted > 0.3);
  // Down to 8x8; below, single texels are too coarse a measure.
  for (std::size_t i = 1; i < 6; ++i) {
    CAPTURE(i);
    CHECK(render::coverage(levels[i]) == doctest::Approx(wanted).epsilon(0.06));
  }
}

TEST_CASE("without kept coverage, holes close or leaves thin out") {
  render::Picture twigs{64, 64, std::vector<std::uint8_t>(64 * 64 * 4, 0)};
  for (std::size_t i = 0; i < 64 * 64; ++i) {
    if (i % 64 % 5 == 0) twigs.rgba[i * 4 + 3] = 255;
  }
  const auto plain = render::mipChain(twigs, 64, 64, false), kept = render::mipChain(twigs, 64, 64, true);
  CHECK(render::coverage(plain[3]) == 0);
  CHECK(render::coverage(kept[3]) > 0.1);
}

TEST_CASE("colours under full transparency never reach a leaf's edge") {
  const auto white = render::mipChain(test::drawnLeaf(120, 200, vec3(0.6f, 0.3f, 0.1f), vec3(1, 1, 1)), 128, 128, true);
  const auto black = render::mipChain(test::drawnLeaf(120, 200, vec3(0.6f, 0.3f, 0.1f), vec3(0, 0, 0)), 128, 128, true);
  for (std::size_t i = 0; i < white.size(); ++i) CHECK(white[i].rgba == black[i].rgba);
}

TEST_CASE("levels are averaged in linear light") {
  // Black and white texels in turns: half the light is sRGB 188, not 128.
  render::Picture board{2, 2, {0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 255, 255, 0, 0, 0, 255}};
  const auto levels = render::mipChain(board, 2, 2, false);
  REQUIRE(levels.size() == 2);
  CHECK(static_cast<int>(levels[1].rgba[0]) == doctest::Approx(188).epsilon(0.01));
  CHECK(levels[1].rgba[3] == 255);
}

TEST_CASE("a picture keeps its mean colour when it is resampled") {
  render::Picture flat{37, 53, {}};
  for (int i = 0; i < 37 * 53; ++i) flat.rgba.insert(flat.rgba.end(), {120, 90, 60, 255});
  const auto levels = render::mipChain(flat, 64, 32, false);
  for (std::size_t i = 0; i < levels[0].rgba.size(); i += 4) {
    CHECK(std::abs(levels[0].rgba[i] - 120) <= 1);
    CHECK(std::abs(levels[0].rgba[i + 2] - 60) <= 1);
  }
}
