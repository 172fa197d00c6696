// Leaves: one call for all, clean edges, light from behind.
#include <doctest/doctest.h>

#include <glm/gtc/quaternion.hpp>

#include "support/render_stage.h"

using namespace windfall;

namespace {

/// One large leaf that faces the camera, in front of the sky.
render::Picture onlyLeaf(test::Stage& stage, const render::Picture& picture, const vec3& toSun, bool hidden = false) {
  render::SceneContent content;
  content.leafCount = 1;
  content.leafLayers.push_back({picture, vec2(0.5f, 1), vec2(0.6f, 1)});
  stage.setContent(content);
  const auto slot = stage.renderer->acquire();
  slot.leaves[0] = LeafInstance{vec3(0, 20, 0), 1, vec4(0, 0, 0, 1), 0, 0, 0, 0};
  if (hidden) slot.leaves[0].state = static_cast<std::uint32_t>(LeafState::Hidden);
  stage.renderer->publish(slot);
  stage.view.eye = {0, 20.5f, 2.2f};
  stage.view.target = {0, 20.5f, 0};
  stage.view.toSun = toSun;
  stage.view.quality = render::Quality::Standard;
  return stage.draw();
}

constexpr int kSize = 160;

}  // namespace

TEST_CASE("a leaf's edge has neither a dark nor a bright rim") {
  test::Stage stage(kSize, kSize);
  WINDFALL_NEEDS_OPENGL(stage);
  const vec3 toSun(0.2f, 0.5f, 1);
  // A flat colour, so that whatever lies outside of the range between leaf and sky is a rim.
  render::Picture leaf = test::drawnLeaf(96, 160, vec3(0.75f, 0.35f, 0.1f), vec3(0, 0, 0));
  for (std::size_t i = 0; i < leaf.rgba.size(); i += 4) {
    if (leaf.rgba[i + 3] == 0) continue;
    leaf.rgba[i] = 190;
    leaf.rgba[i + 1] = 90;
    leaf.rgba[i + 2] = 30;
  }
  for (std::size_t i = 0; i < leaf.rgba.size(); i += 8) {
    if (leaf.rgba[i + 3] == 0) leaf.rgba[i] = leaf.rgba[i + 1] = leaf.rgba[i + 2] = 255;
  }
  const render::Picture picture = onlyLeaf(stage, leaf, toSun);
  const render::Picture bare = onlyLeaf(stage, leaf, toSun, true);
  float darkest = 1e9f, brightest = 0;
  int covered = 0;
  // The blade's inside gives the range of its shading.
  const auto at = [](const render::Picture& from, int x, int y) { return test::meanColor(from, x, y, x + 1, y + 1); };
  std::vector<bool> touched(kSize * kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      touched[static_cast<std::size_t>(y * kSize + x)] = glm::length(at(picture, x, y) - at(bare, x, y)) > 4;
    }
  }
  const auto inside = [&](int x, int y, int reach) {
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const int px = x + dx, py = y + dy;
        if (px < 0 || py < 0 || px >= kSize || py >= kSize || !touched[static_cast<std::size_t>(py * kSize + px)])
          return false;
      }
    }
    return true;
  };
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      if (!inside(x, y, 3)) continue;
      const float value = test::brightness(at(picture, x, y));
      darkest = std::min(darkest, value);
      brightest = std::max(brightest, value);
      ++covered;
    }
  }
  REQUIRE(covered > 500);
  int rims = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      if (!touched[static_cast<std::size_t>(y * kSize + x)] || inside(x, y, 3)) continue;
      const float value = test::brightness(at(picture, x, y)), sky = test::brightness(at(bare, x, y));
      if (value < std::min(darkest, sky) - 6 || value > std::max(brightest, sky) + 6) ++rims;
    }
  }
  CHECK(rims == 0);
  if (rims != 0) test::keep(picture, "render_leaf_edge");
}

TEST_CASE("a leaf against the sun glows in its own colour") {
  test::Stage stage(kSize, kSize);
  WINDFALL_NEEDS_OPENGL(stage);
  const render::Picture leaf = test::drawnLeaf(96, 160, vec3(0.85f, 0.55f, 0.12f));
  const render::Picture behind = onlyLeaf(stage, leaf, vec3(0.1f, 0.25f, -1));
  const vec3 lit = test::meanColor(behind, 74, 70, 86, 90);
  stage.view.sunStrength = 0;
  const vec3 unlit = test::meanColor(onlyLeaf(stage, leaf, vec3(0.1f, 0.25f, -1)), 74, 70, 86, 90);
  CHECK(lit.x > unlit.x + 25);
  CHECK(lit.x > lit.z + 40);
  test::keep(behind, "render_leaf_backlit");
}

TEST_CASE("hidden leaves are not drawn") {
  test::Stage stage(kSize, kSize);
  WINDFALL_NEEDS_OPENGL(stage);
  const render::Picture leaf = test::drawnLeaf(48, 80, vec3(0.9f, 0.1f, 0.05f));
  const vec3 shown = test::meanColor(onlyLeaf(stage, leaf, vec3(0, 1, 1)), 74, 70, 86, 90);
  const vec3 gone = test::meanColor(onlyLeaf(stage, leaf, vec3(0, 1, 1), true), 74, 70, 86, 90);
  CHECK(shown.x - shown.z > gone.x - gone.z + 30);
}

TEST_CASE("all leaves of a tree take one draw call") {
  test::Stage stage(96, 64);
  WINDFALL_NEEDS_OPENGL(stage);
  const test::GrownTree tree(2, 500);
  stage.setContent(test::contentOf(tree));
  const auto slot = stage.renderer->acquire();
  tree.write(slot, 0);
  stage.renderer->publish(slot);
  stage.draw();
  CHECK(stage.renderer->lastDraw().leafCalls == 1);
  CHECK(stage.renderer->lastDraw().calls <= 7);
}

namespace {

/// A layer of plain colour, a leaf length square about the middle of its base.
render::LeafLayer plainLayer(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  render::LeafLayer layer;
  layer.picture = {64, 64, {}};
  for (int i = 0; i < 64 * 64; ++i) layer.picture.rgba.insert(layer.picture.rgba.end(), {r, g, b, 255});
  layer.pivot = {0.5f, 1};
  layer.extent = {1, 1};
  return layer;
}

render::LeafShape halfQuad(float left, float right) {
  render::LeafShape shape;
  for (const vec2 uv : {vec2(left, 1), vec2(right, 1), vec2(right, 0), vec2(left, 0)}) {
    shape.corners.push_back({{uv.x - 0.5f, 1 - uv.y}, uv.x - 0.5f, uv});
  }
  shape.indices = {0, 1, 2, 0, 2, 3};
  return shape;
}

/// One leaf of a layer, its face to the camera `distance` away.
render::Picture leafAt(test::Stage& stage, const render::LeafLayer& layer, float distance, float season = 0,
                       std::size_t count = 1) {
  render::SceneContent content;
  content.leafCount = count;
  content.leafLayers.push_back(layer);
  stage.setContent(content);
  const auto slot = stage.renderer->acquire();
  for (std::size_t i = 0; i < count; ++i) {
    slot.leaves[i] = LeafInstance{vec3(0, 20, -0.001f * float(i)), 1, vec4(0, 0, 0, 1), 0, 0, 0, 0};
  }
  stage.renderer->publish(slot);
  stage.view.eye = {0, 20.5f, distance};
  stage.view.target = {0, 20.5f, 0};
  stage.view.toSun = {0.2f, 0.6f, 1};
  stage.view.season = season;
  stage.view.quality = render::Quality::Standard;
  return stage.draw();
}

}  // namespace

TEST_CASE("the size on the screen chooses the level of detail") {
  test::Stage stage(kSize, kSize);
  WINDFALL_NEEDS_OPENGL(stage);
  // Only the finest level lacks its right half, and only the coarsest its left one.
  render::LeafLayer layer = plainLayer(250, 20, 20);
  layer.levels = {halfQuad(0, 0.5f), halfQuad(0, 1), halfQuad(0, 1), halfQuad(0.5f, 1)};
  const auto red = [](const render::Picture& picture, int x, int y) {
    const vec3 c = test::meanColor(picture, x, y, x + 1, y + 1);
    return c.x > c.z + 40;
  };
  const render::Picture near = leafAt(stage, layer, 2);  // about 110 px
  CHECK(red(near, 70, 80));
  CHECK_FALSE(red(near, 95, 80));
  const render::Picture middle = leafAt(stage, layer, 4.5f);
  CHECK(red(middle, 75, 80));
  CHECK(red(middle, 86, 80));
  const render::Picture far = leafAt(stage, layer, 36);
  CHECK(red(far, 81, 80));
  CHECK_FALSE(red(far, 77, 80));
  CHECK(stage.renderer->lastDraw().leafCalls == 1);
}

TEST_CASE("leaves turn with the season, each in its time") {
  test::Stage stage(kSize, kSize);
  WINDFALL_NEEDS_OPENGL(stage);
  render::LeafLayer layer = plainLayer(40, 110, 30);
  layer.gains = {vec3(8, 2, 1), vec3(5, 0.5f, 1), vec3(7, 0.4f, 1)};
  for (std::size_t i = 0; i < render::kSeasonSamples; ++i) {
    const float t = static_cast<float>(i) / 16;
    layer.seasons[i] = vec4(1 - t, t * (1 - t), 0, t * t);
  }
  const vec3 summer = test::meanColor(leafAt(stage, layer, 2), 70, 70, 78, 90);
  const vec3 autumn = test::meanColor(leafAt(stage, layer, 2, 1), 70, 70, 78, 90);
  CHECK(summer.y > summer.x);
  CHECK(autumn.x > autumn.y);
}

TEST_CASE("a normal map tilts the light on a near leaf") {
  test::Stage stage(kSize, kSize);
  WINDFALL_NEEDS_OPENGL(stage);
  render::LeafLayer layer = plainLayer(90, 130, 60);
  const auto tilted = [&](std::uint8_t x, std::uint8_t y) {
    layer.surface = {4, 4, {}};
    for (int i = 0; i < 16; ++i) layer.surface.rgba.insert(layer.surface.rgba.end(), {x, y, 200, 255});
    return test::brightness(test::meanColor(leafAt(stage, layer, 2), 70, 70, 90, 90));
  };
  // The sun stands above and in front: green, up the leaf, is towards it.
  CHECK(tilted(128, 150) > tilted(128, 100) + 2);
  CHECK(tilted(128, 60) < tilted(128, 128) - 4);
}

TEST_CASE("leaves behind the camera are left out, those at its border are not") {
  test::Stage stage(kSize, kSize);
  WINDFALL_NEEDS_OPENGL(stage);
  const render::LeafLayer layer = plainLayer(250, 20, 20);
  const render::Picture many = leafAt(stage, layer, 2, 0, 700);
  CHECK(test::meanColor(many, 76, 76, 84, 84).x > 100);
  stage.view.target = {0, 20.5f, 5};
  const render::Picture away = stage.draw();
  const vec3 sky = test::meanColor(away, 76, 20, 84, 28);
  CHECK(sky.x < sky.z + 40);
  // A leaf whose petiole's end is out of the picture while its blade is in it.
  stage.view.eye = {0, 21.15f, 2};
  stage.view.target = {0, 21.15f, 0};
  stage.view.fieldOfView = 0.5f;
  const render::Picture border = stage.draw();
  const vec3 low = test::meanColor(border, 76, kSize - 12, 84, kSize - 4);
  CHECK(low.x > low.z + 40);
}

TEST_CASE("leaves without a texture are refused in one line") {
  test::Stage stage(32, 32);
  WINDFALL_NEEDS_OPENGL(stage);
  render::SceneContent content;
  content.leafCount = 3;
  const Status refused = stage.renderer->setContent(content);
  REQUIRE_FALSE(bool(refused));
  CHECK(refused.error().message == "leaves without a leaf texture");
  stage.draw();
}
