// A coarse picture: a quarter of the shading, but edges of the picture's own resolution.
#include <doctest/doctest.h>

#include <cstdlib>

#include "support/render_stage.h"

using namespace windfall;

namespace {

/// Mean difference of a channel, 0..255.
double differenceOf(const render::Picture& a, const render::Picture& b) {
  REQUIRE(a.rgba.size() == b.rgba.size());
  double sum = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::abs(int{a.rgba[i]} - int{b.rgba[i]});
  return sum / static_cast<double>(a.rgba.size());
}

/// Each pixel as four.
render::Picture doubled(const render::Picture& from) {
  render::Picture to{2 * from.width, 2 * from.height, {}};
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      const std::size_t at = 4 * (static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(from.width) +
                                  static_cast<std::size_t>(x / 2));
      for (std::size_t c = 0; c < 4; ++c) to.rgba.push_back(from.rgba[at + c]);
    }
  }
  return to;
}

/// Bars that lie aslant before the sky.
render::SceneContent bars() {
  render::SceneContent content;
  render::Mesh mesh;
  for (int bar = 0; bar < 9; ++bar) {
    const float x = -4.0f + static_cast<float>(bar), wide = 0.06f + 0.03f * static_cast<float>(bar);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const vec3 place : {vec3(x, 0, 0), vec3(x + wide, 0, 0), vec3(x + 0.7f, 5, 0), vec3(x + 0.7f + wide, 5, 0)}) {
      render::Vertex vertex;
      vertex.position = place;
      vertex.normal = vec3(0, 0, 1);
      vertex.weights[0] = 1;
      mesh.vertices.push_back(vertex);
    }
    for (const std::uint32_t index : {0u, 1u, 2u, 1u, 3u, 2u}) mesh.indices.push_back(first + index);
  }
  mesh.materials.push_back({vec4(0.05f, 0.04f, 0.03f, 1), -1, 0.9f, false});
  mesh.parts.push_back({0, static_cast<std::uint32_t>(mesh.indices.size()), 0});
  content.meshes.push_back(mesh);
  content.trees.push_back({0, 0, 1});
  content.linkCount = 1;
  return content;
}

void show(test::Stage& stage) {
  stage.view.quality = render::Quality::Standard;
  stage.view.eye = {0, 2.2f, 9};
  stage.view.target = {0, 2.4f, 0};
  stage.setContent(bars());
  const auto slot = stage.renderer->acquire();
  slot.bones[0] = mat4(1);
  stage.renderer->publish(slot);
}

}  // namespace

TEST_CASE("a coarse picture is nearer to the fine one than a picture of half its size") {
  test::Stage stage(240, 160), small(120, 80);
  WINDFALL_NEEDS_OPENGL(stage);
  show(small);
  const render::Picture half = doubled(small.draw());
  show(stage);
  const render::Picture fine = stage.draw();
  stage.view.coarse = true;
  const render::Picture coarse = stage.draw();
  const double ofCoarse = differenceOf(fine, coarse), ofHalf = differenceOf(fine, half);
  CHECK(ofCoarse > 0);
  const bool near = ofCoarse < 0.8 * ofHalf;
  CHECK_MESSAGE(near, "coarse differs by " << ofCoarse << ", half by " << ofHalf);
  if (!near) test::keep(fine, "coarse-expected"), test::keep(coarse, "coarse-actual");
}

TEST_CASE("after a coarse picture the next fine one is as if there had been none") {
  test::Stage stage(161, 91);
  WINDFALL_NEEDS_OPENGL(stage);
  show(stage);
  const render::Picture before = stage.draw();
  stage.view.coarse = true;
  stage.draw();
  stage.view.coarse = false;
  CHECK(stage.draw().rgba == before.rgba);
}
