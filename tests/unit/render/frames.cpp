// Frame slots go round without ever touching what is being shown.
#include <doctest/doctest.h>

#include <set>

#include "support/render_stage.h"

using namespace windfall;

namespace {
render::SceneContent linksAndLeaves(std::size_t links, std::size_t leaves) {
  render::SceneContent content;
  content.linkCount = links;
  content.leafCount = leaves;
  content.leafLayers.push_back({test::drawnLeaf(16, 32, vec3(0.8f, 0.4f, 0.1f)), vec2(0.5f, 1), vec2(0.5f, 1)});
  return content;
}
}  // namespace

TEST_CASE("three slots go round, and the one that is shown is never handed out") {
  test::Stage stage(32, 32);
  WINDFALL_NEEDS_OPENGL(stage);
  stage.setContent(linksAndLeaves(5, 7));
  std::set<int> seen;
  int shown = -1;
  for (int i = 0; i < 12; ++i) {
    const render::FrameSlot slot = stage.renderer->acquire();
    REQUIRE(slot.index >= 0);
    CHECK(slot.index != shown);
    CHECK(slot.bones.size() == 5);
    CHECK(slot.leaves.size() == 7);
    std::fill(slot.leaves.begin(), slot.leaves.end(), LeafInstance{});
    std::fill(slot.bones.begin(), slot.bones.end(), mat4(1));
    stage.renderer->publish(slot);
    stage.draw();
    shown = stage.renderer->lastDraw().slot;
    CHECK(shown == slot.index);
    seen.insert(slot.index);
  }
  CHECK(seen.size() == 3);
}

TEST_CASE("two slots may be held, a third is refused, and the newest published one is shown") {
  test::Stage stage(32, 32);
  WINDFALL_NEEDS_OPENGL(stage);
  stage.setContent(linksAndLeaves(1, 0));
  const auto first = stage.renderer->acquire();
  stage.renderer->publish(first);
  const auto a = stage.renderer->acquire(), b = stage.renderer->acquire();
  CHECK(a.index >= 0);
  CHECK(b.index >= 0);
  CHECK(std::set<int>{first.index, a.index, b.index}.size() == 3);
  CHECK(stage.renderer->acquire().index == -1);
  stage.renderer->publish(b);
  stage.draw();
  CHECK(stage.renderer->lastDraw().slot == b.index);
}

TEST_CASE("slots do not overlap and keep what was written") {
  test::Stage stage(32, 32);
  WINDFALL_NEEDS_OPENGL(stage);
  stage.setContent(linksAndLeaves(33, 101));
  const auto a = stage.renderer->acquire(), b = stage.renderer->acquire();
  std::fill(a.bones.begin(), a.bones.end(), mat4(2));
  std::fill(b.bones.begin(), b.bones.end(), mat4(3));
  for (LeafInstance& leaf : a.leaves) leaf = LeafInstance{vec3(1), 1, vec4(0, 0, 0, 1), 0, 0, 0, 0};
  for (LeafInstance& leaf : b.leaves) leaf = LeafInstance{vec3(2), 1, vec4(0, 0, 0, 1), 0, 0, 0, 0};
  CHECK(a.bones[32][0][0] == 2);
  CHECK(b.bones[0][0][0] == 3);
  CHECK(a.leaves[100].position.x == 1);
  CHECK(b.leaves[0].position.x == 2);
}

TEST_CASE("before a first frame nothing but ground and sky is drawn") {
  test::Stage stage(32, 32);
  WINDFALL_NEEDS_OPENGL(stage);
  stage.setContent(linksAndLeaves(3, 3));
  stage.draw();
  CHECK(stage.renderer->lastDraw().slot == -1);
  CHECK(stage.renderer->lastDraw().leafCalls == 0);
}
