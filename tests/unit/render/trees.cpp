// Trees: skin, shadow, highlight, and content that does not fit together.
#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "support/render_stage.h"

using namespace windfall;

namespace {

/// A post of two links, 4 m high, before the camera.
render::SceneContent post() {
  render::SceneContent content;
  render::Mesh mesh;
  for (int ring = 0; ring < 5; ++ring) {
    for (int corner = 0; corner < 4; ++corner) {
      const float angle = 1.5707963f * static_cast<float>(corner) + 0.785f;
      render::Vertex vertex;
      vertex.normal = vec3(std::cos(angle), 0, std::sin(angle));
      vertex.position = vertex.normal * 0.3f + vec3(0, static_cast<float>(ring), 0);
      vertex.links[0] = ring < 2 ? 0 : 1;
      vertex.links[1] = ring < 3 ? 0 : 1;
      vertex.weights[0] = vertex.weights[1] = 0.5f;
      mesh.vertices.push_back(vertex);
    }
  }
  for (std::uint32_t ring = 0; ring < 4; ++ring) {
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
      const std::uint32_t a = ring * 4 + corner, b = ring * 4 + (corner + 1) % 4;
      for (const std::uint32_t index : {a, b, a + 4, b, b + 4, a + 4}) mesh.indices.push_back(index);
    }
  }
  mesh.materials.push_back({vec4(0.3f, 0.25f, 0.2f, 1), -1, 0.9f, false});
  mesh.parts.push_back({0, static_cast<std::uint32_t>(mesh.indices.size()), 0});
  content.meshes.push_back(mesh);
  content.trees.push_back({0, 1, 2});
  content.linkCount = 3;
  return content;
}

void pose(test::Stage& stage, const mat4& upper) {
  const auto slot = stage.renderer->acquire();
  slot.bones[0] = mat4(0);
  slot.bones[1] = mat4(1);
  slot.bones[2] = upper;
  stage.renderer->publish(slot);
}

void look(test::Stage& stage) {
  stage.view.eye = {0, 2.5f, 12};
  stage.view.target = {0, 2.2f, 0};
  stage.view.toSun = {0.9f, 0.7f, 0.4f};
}

}  // namespace

TEST_CASE("a link's matrix moves the vertices that hang on it, and only those") {
  test::Stage stage(192, 128);
  WINDFALL_NEEDS_OPENGL(stage);
  look(stage);
  stage.setContent(post());
  pose(stage, mat4(1));
  const render::Picture straight = stage.draw();
  pose(stage, glm::translate(mat4(1), vec3(1.5f, 0, 0)));
  const render::Picture moved = stage.draw();
  // Post in the middle of the picture: its head leaves, its foot stays.
  const auto difference = [&](int y0, int y1) {
    return glm::length(test::meanColor(straight, 92, y0, 100, y1) - test::meanColor(moved, 92, y0, 100, y1));
  };
  CHECK(difference(38, 52) > 15);
  CHECK(difference(88, 92) < 6);
  CHECK(glm::length(test::meanColor(straight, 116, 38, 126, 52) - test::meanColor(moved, 116, 38, 126, 52)) > 10);
}

TEST_CASE("a tree darkens the ground behind it, away from the sun") {
  test::Stage stage(192, 128);
  WINDFALL_NEEDS_OPENGL(stage);
  look(stage);
  stage.view.eye = {0, 9, 14};
  stage.view.target = {-2, 0, 0};
  stage.setContent(post());
  const render::Picture bare = stage.draw();
  pose(stage, mat4(1));
  const render::Picture shaded = stage.draw();
  // The post stands at column 118; the sun is to its right.
  int left = 0, right = 0;
  for (int y = 40; y < 120; ++y) {
    for (int x = 0; x < 192; ++x) {
      const float change = test::brightness(test::meanColor(shaded, x, y, x + 1, y + 1)) -
                           test::brightness(test::meanColor(bare, x, y, x + 1, y + 1));
      if (change < -18) ++(x < 114 ? left : right);
    }
  }
  CAPTURE(left);
  CHECK(left > 60);
  CHECK(right < left / 2);  // the post itself
  if (left <= 60) test::keep(shaded, "render_shadow");
}

TEST_CASE("a highlighted link changes its colour and leaves the other as it was") {
  test::Stage stage(192, 128);
  WINDFALL_NEEDS_OPENGL(stage);
  look(stage);
  stage.setContent(post());
  pose(stage, mat4(1));
  const render::Picture plain = stage.draw();
  stage.view.highlighted = {2};
  const render::Picture chosen = stage.draw();
  stage.view.highlighted = {};
  const render::Picture again = stage.draw();
  const vec3 before = test::meanColor(plain, 94, 40, 98, 50), after = test::meanColor(chosen, 94, 40, 98, 50);
  CHECK(after.z - after.x > before.z - before.x + 30);
  CHECK(glm::length(test::meanColor(plain, 94, 86, 98, 92) - test::meanColor(chosen, 94, 86, 98, 92)) < 3);
  CHECK(again.rgba == plain.rgba);
}

TEST_CASE("content that names what it does not have is refused, and the renderer goes on") {
  test::Stage stage(32, 32);
  WINDFALL_NEEDS_OPENGL(stage);
  const auto refusal = [&](const render::SceneContent& content) {
    const Status status = stage.renderer->setContent(content);
    return status ? std::string() : status.error().message;
  };
  render::SceneContent content = post();
  content.meshes[0].indices[3] = 999;
  CHECK(refusal(content) == "mesh 1: an index names a vertex that is not there");
  content = post();
  content.meshes[0].parts[0].indexCount += 3;
  CHECK(refusal(content) == "mesh 1: a part names indices that are not there");
  content = post();
  content.meshes[0].vertices[2].links[3] = 2;
  CHECK(refusal(content) == "mesh 1: a vertex names a link that is not there");
  content = post();
  content.trees[0].linkCount = 5;
  CHECK(refusal(content) == "a tree names links that are not there");
  content = post();
  content.trees[0].mesh = 1;
  CHECK(refusal(content) == "a tree names a mesh that is not there");
  stage.draw();
  CHECK(refusal(post()).empty());
}

TEST_CASE("two trees share a mesh and one draw call") {
  test::Stage stage(64, 64);
  WINDFALL_NEEDS_OPENGL(stage);
  render::SceneContent content = post();
  stage.setContent(content);
  pose(stage, mat4(1));
  stage.draw();
  const int calls = stage.renderer->lastDraw().calls;
  content.trees.push_back({0, 0, 2});
  stage.setContent(content);
  pose(stage, mat4(1));
  stage.draw();
  CHECK(stage.renderer->lastDraw().calls == calls);
}
