// Narrow leaves and sprays of needles cover as much of the picture far away as near by.
#include <doctest/doctest.h>

#include "support/leafy_crown.h"

using namespace windfall;

namespace {

constexpr int kSize = 128;  // px, a side
constexpr float kFieldOfView = 0.12f;

/// A blade of `share` of its picture's width, and where `needles` are asked for so many of them in its place, half of
/// it open; the far shapes are cut close round it, as those of real leaves are.
render::LeafLayer narrowLayer(float share, int needles = 0, bool solid = false) {
  render::LeafLayer layer;
  constexpr int kSide = 256;
  layer.picture = {kSide, kSide, {}};
  for (int i = 0; i < kSide * kSide; ++i) {
    const float x = (static_cast<float>(i % kSide) + 0.5f) / kSide - 0.5f;
    const float across = (x / share + 0.5f) * static_cast<float>(needles);
    const bool blade = std::abs(x) < 0.5f * share && (needles == 0 || across - std::floor(across) < 0.5f);
    layer.picture.rgba.insert(layer.picture.rgba.end(),
                              {60, 90, 30, static_cast<std::uint8_t>(blade || solid ? 255 : 0)});
  }
  layer.pivot = {0.5f, 1};
  layer.extent = {1, 1};
  layer.halfWidth = 0.5f * share;
  for (render::LeafShape& shape : layer.levels) {
    for (const vec2 corner : {vec2(-1, 0), vec2(1, 0), vec2(-1, 1), vec2(1, 1)}) {
      const vec2 place(0.505f * share * corner.x, corner.y);
      shape.corners.push_back({place, place.x, {place.x + 0.5f, 1 - place.y}});
    }
    shape.indices = {0, 1, 2, 2, 1, 3};
  }
  return layer;
}

/// Share of the picture that the crown covers where its leaves are `pixels` long, in a picture `finer` times as fine.
double coveredAt(test::Stage& stage, const test::LeafyCrown& crown, float pixels, int finer) {
  const int side = kSize * finer;
  REQUIRE(bool(stage.context->resize(side, side)));
  stage.view.width = stage.view.height = side;
  const float distance = test::kCrownLeaf * (kSize / (2 * std::tan(kFieldOfView / 2))) / pixels;
  const vec3 middle(0, test::kCrownHeight + 1.6f, 0);
  stage.view.eye = middle + vec3(0, 0, distance);
  stage.view.target = middle;
  stage.view.fieldOfView = kFieldOfView;
  stage.view.quality = render::Quality::High;
  stage.view.cardsBelow = 0;
  const render::FrameSlot slot = stage.renderer->acquire();
  crown.write(slot, crown.standing(), [](std::size_t) { return false; });
  stage.renderer->publish(slot);
  stage.draw();
  return test::coveredSamples(*stage.renderer, side, side, 2 * distance).share;
}

}  // namespace

TEST_CASE("narrow leaves and needles keep what they cover with the distance") {
  test::Stage stage(kSize, kSize);
  WINDFALL_NEEDS_OPENGL(stage);
  const test::LeafyCrown crown;
  struct Kind {
    float share;
    int needles;
  };
  for (const Kind& kind : {Kind{0.8f, 0}, Kind{0.2f, 0}, Kind{0.06f, 0}, Kind{0.6f, 12}}) {
    for (const float pixels : {8.0f, 4.0f, 2.5f}) {
      stage.setContent(crown.content(narrowLayer(kind.share, kind.needles)));
      const double actual = coveredAt(stage, crown, pixels, 1);
      // Sixty-four times as many samples; of a blade alone its shape, without a picture that could be blurred.
      stage.setContent(crown.content(narrowLayer(kind.share, kind.needles, kind.needles == 0)));
      const double wanted = coveredAt(stage, crown, pixels, 8);
      INFO("share " << kind.share << ", needles " << kind.needles << ", leaves of " << pixels << " px: covered "
                    << actual << ", expected " << wanted);
      CHECK(actual == test::within(wanted, 0.09));
    }
  }
}
