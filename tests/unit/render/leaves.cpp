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
