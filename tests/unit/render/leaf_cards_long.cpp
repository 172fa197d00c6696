// Far away, cards of clusters show what the leaves showed: as much of the picture, in the same colour, as many leaves,
// in the same wind.
#include <doctest/doctest.h>

#include <optional>

#include "support/leafy_crown.h"

using namespace windfall;

namespace {

constexpr int kSize = 160;  // px, a side
constexpr float kFieldOfView = 0.12f;
constexpr float kBelow = 2;  // px of a leaf
const vec3 kMiddle(0, test::kCrownHeight + 1.6f, 0);

render::LeafLayer ovateLayer(float width, vec3 color = vec3(0.25f, 0.42f, 0.12f)) {
  render::LeafLayer layer;
  layer.picture = test::drawnLeaf(128, 128, color);
  layer.pivot = {0.5f, 1};
  layer.extent = {width, 1};
  layer.halfWidth = 0.45f * width;
  return layer;
}

/// A crown seen from where its leaves are `pixels` long.
struct Sight {
  float pixels = 1, season = 0;
  vec3 direction{0, 0.05f, 1};
  bool cards = true;
  int finer = 1;  ///< times as many pixels, for what is to be expected
  std::vector<mat4> moved;
  std::size_t keep = 1;  ///< of so many leaves one is left
};

struct Shown {
  test::CoveredSamples covered;
  vec3 color{0};  ///< mean of the picture, 0..255
  int cardCalls = 0;
};

Shown show(test::Stage& stage, const test::LeafyCrown& crown, const render::LeafLayer& layer, const Sight& sight) {
  const int side = kSize * sight.finer;
  REQUIRE(bool(stage.context->resize(side, side)));
  stage.view.width = stage.view.height = side;
  stage.setContent(crown.content(layer));
  const float distance = test::kCrownLeaf * (kSize / (2 * std::tan(kFieldOfView / 2))) / sight.pixels;
  stage.view.eye = kMiddle + glm::normalize(sight.direction) * distance;
  stage.view.target = kMiddle;
  stage.view.fieldOfView = kFieldOfView;
  stage.view.toSun = {0.4f, 0.7f, 0.5f};
  stage.view.season = sight.season;
  stage.view.quality = render::Quality::High;
  // High halves it.
  stage.view.cardsBelow = sight.cards ? 2 * kBelow : 0;
  const render::FrameSlot slot = stage.renderer->acquire();
  crown.write(
      slot, sight.moved.empty() ? crown.standing() : sight.moved, [&](std::size_t i) { return i % sight.keep != 0; },
      sight.season);
  stage.renderer->publish(slot);
  const render::Picture picture = stage.draw();
  Shown shown;
  shown.cardCalls = stage.renderer->lastDraw().cardCalls;
  shown.covered = test::coveredSamples(*stage.renderer, side, side, 2 * distance);
  double sums[4]{};
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) sums[i % 4] += picture.rgba[i];
  shown.color = vec3(sums[0], sums[1], sums[2]) * (4.0f / static_cast<float>(picture.rgba.size()));
  return shown;
}

/// The same without cards in a picture so fine that no leaf is thinned.
Shown expected(test::Stage& stage, const test::LeafyCrown& crown, const render::LeafLayer& layer, Sight sight) {
  sight.cards = false;
  sight.finer = 4;
  return show(stage, crown, layer, sight);
}

}  // namespace

TEST_CASE("cards cover what their leaves cover from every distance, while they come and after") {
  test::Stage stage(kSize, kSize);
  WINDFALL_NEEDS_OPENGL(stage);
  const test::LeafyCrown crown;
  const render::LeafLayer layer = ovateLayer(0.6f);
  // Leaves alone, half and half, clusters, clusters and boughs, boughs.
  for (const float pixels : {3.0f, 2.35f, 1.6f, 1.0f, 0.6f, 0.4f}) {
    double actual = 0, wanted = 0;
    for (const vec3& from : {vec3(0, 0.05f, 1), vec3(0.9f, 0.1f, 0.3f), vec3(-0.6f, 0.05f, -0.7f)}) {
      Sight sight{pixels};
      sight.direction = from;
      const Shown shown = show(stage, crown, layer, sight);
      CHECK(shown.cardCalls == (pixels < 2.7f ? 1 : 0));
      actual += shown.covered.share / 3;
      wanted += expected(stage, crown, layer, sight).covered.share / 3;
    }
    INFO("leaves of " << pixels << " px: covered " << actual << ", expected " << wanted);
    CHECK(actual == test::within(wanted, 0.03));
  }
}

TEST_CASE("cards cover what their leaves cover from all sides, and of narrow leaves") {
  test::Stage stage(kSize, kSize);
  WINDFALL_NEEDS_OPENGL(stage);
  const test::LeafyCrown crown;
  const vec3 sides[] = {{1, 0.3f, 0.2f}, {-0.7f, 0.8f, 0.5f}, {0.1f, 1, 0.05f}, {-0.4f, -0.4f, -0.8f}};
  for (const float width : {0.6f, 0.12f}) {
    const render::LeafLayer layer = ovateLayer(width);
    for (const vec3& side : sides) {
      Sight sight{1.3f};
      sight.direction = side;
      const Shown actual = show(stage, crown, layer, sight), wanted = expected(stage, crown, layer, sight);
      INFO("width " << width << ", from " << side.x << " " << side.y << " " << side.z << ": covered "
                    << actual.covered.share << ", expected " << wanted.covered.share);
      CHECK(actual.covered.share == test::within(wanted.covered.share, 0.05));
    }
  }
}

TEST_CASE("cards have the colour of their leaves, in summer and as they turn") {
  test::Stage stage(kSize, kSize);
  WINDFALL_NEEDS_OPENGL(stage);
  const test::LeafyCrown crown;
  render::LeafLayer layer = ovateLayer(0.6f);
  layer.gains = {vec3(3, 1.8f, 0.6f), vec3(3, 0.6f, 0.5f), vec3(1, 0.6f, 0.4f)};
  for (std::size_t i = 0; i < render::kSeasonSamples; ++i) {
    const float turned = static_cast<float>(i) / (render::kSeasonSamples - 1);
    layer.seasons[i] = vec4(1 - turned, turned, 0, 0);
  }
  for (const vec3& from : {vec3(0, 0.05f, 1), vec3(-0.5f, 0.3f, -1)}) {
    for (const float season : {0.0f, 0.6f}) {
      Sight sight{1.3f, season};
      sight.direction = from;
      Sight bare = sight;
      bare.keep = crown.leafCount + 1;
      const Shown actual = show(stage, crown, layer, sight), wanted = expected(stage, crown, layer, sight);
      // What leaves do to the picture, channel by channel.
      const vec3 got = show(stage, crown, layer, bare).color - actual.color;
      const vec3 want = expected(stage, crown, layer, bare).color - wanted.color;
      INFO("season " << season << ": " << got.x << " " << got.y << " " << got.z << ", expected " << want.x << " "
                     << want.y << " " << want.z);
      for (int c = 0; c < 3; ++c) CHECK(std::abs(got[c] - want[c]) <= 0.12f * glm::length(want));
    }
  }
}

TEST_CASE("cards thin out as their leaves fall, and are gone with the last") {
  test::Stage stage(kSize, kSize);
  WINDFALL_NEEDS_OPENGL(stage);
  const test::LeafyCrown crown;
  const render::LeafLayer layer = ovateLayer(0.6f);
  for (const std::size_t keep : {std::size_t{2}, std::size_t{6}}) {
    Sight sight{1.3f};
    sight.keep = keep;
    const Shown actual = show(stage, crown, layer, sight), wanted = expected(stage, crown, layer, sight);
    INFO("one of " << keep << ": covered " << actual.covered.share << ", expected " << wanted.covered.share);
    CHECK(actual.covered.share == test::within(wanted.covered.share, 0.15));
  }
  Sight none{1.3f};
  none.keep = crown.leafCount + 1;
  // The first leaf is left.
  CHECK(show(stage, crown, layer, none).covered.share < 0.001);
}

TEST_CASE("cards bend with the joints that carry them") {
  test::Stage stage(kSize, kSize);
  WINDFALL_NEEDS_OPENGL(stage);
  const test::LeafyCrown crown;
  const render::LeafLayer layer = ovateLayer(0.6f);
  Sight sight{1.3f};
  // The whole tree leans about its foot.
  const mat4 lean =
      glm::translate(mat4(1), vec3(0, test::kCrownHeight, 0)) * glm::rotate(mat4(1), -0.5f, vec3(0, 0, 1));
  sight.moved.assign(crown.tree->links.size(), lean);
  const Shown actual = show(stage, crown, layer, sight), wanted = expected(stage, crown, layer, sight),
              rest = show(stage, crown, layer, {1.3f});
  INFO("middle " << actual.covered.middle.x << " " << actual.covered.middle.y << ", expected "
                 << wanted.covered.middle.x << " " << wanted.covered.middle.y);
  CHECK(glm::distance(wanted.covered.middle, rest.covered.middle) > 0.02f);
  CHECK(glm::distance(actual.covered.middle, wanted.covered.middle) < 0.004f);
  CHECK(actual.covered.share == test::within(wanted.covered.share, 0.04));
}

TEST_CASE("near leaves are drawn as without cards, to the last bit") {
  test::Stage stage(256, 256);
  WINDFALL_NEEDS_OPENGL(stage);
  const test::LeafyCrown crown(5, 6);
  stage.setContent(crown.content(ovateLayer(0.6f)));
  stage.view.eye = kMiddle + vec3(0, 0, 5);
  stage.view.target = kMiddle;
  std::optional<std::vector<std::uint8_t>> first;
  for (const float below : {0.0f, 1.5f}) {
    stage.view.cardsBelow = below;
    const render::FrameSlot slot = stage.renderer->acquire();
    crown.write(slot, crown.standing(), [](std::size_t) { return false; });
    stage.renderer->publish(slot);
    const render::Picture picture = stage.draw();
    CHECK(stage.renderer->lastDraw().cardCalls == 0);
    CHECK_FALSE(stage.renderer->lastDraw().unfinished);
    if (!first) first = picture.rgba;
    CHECK(picture.rgba == *first);
  }
}

TEST_CASE("a live view gets its cards in the end, a few pictures in each frame") {
  test::Stage stage(64, 64);
  WINDFALL_NEEDS_OPENGL(stage);
  const test::LeafyCrown crown(5, 6);
  stage.setContent(crown.content(ovateLayer(0.6f)));
  stage.view.eye = kMiddle + vec3(0, 0, 400);
  stage.view.target = kMiddle;
  int frames = 0;
  for (; frames < 10'000; ++frames) {
    const render::FrameSlot slot = stage.renderer->acquire();
    crown.write(slot, crown.standing(), [](std::size_t) { return false; });
    stage.renderer->publish(slot);
    stage.draw();
    if (stage.renderer->lastDraw().cardCalls > 0) break;
    CHECK(stage.renderer->lastDraw().unfinished);
  }
  CHECK(frames >= 2);
  CHECK(stage.renderer->lastDraw().cardCalls == 1);
  CHECK_FALSE(stage.renderer->lastDraw().unfinished);
  // While it is coarse it has none, and does not wait for any.
  stage.view.coarse = true;
  stage.draw();
  CHECK(stage.renderer->lastDraw().cardCalls == 0);
  CHECK_FALSE(stage.renderer->lastDraw().unfinished);
  stage.view.coarse = false;
  stage.draw();
  CHECK(stage.renderer->lastDraw().cardCalls == 1);
}
