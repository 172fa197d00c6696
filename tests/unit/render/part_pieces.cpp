// Parts of many small pieces thin out with distance, and the picture does not show it.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "kernels/random.h"
#include "support/render_stage.h"
#include "widgets/render/part_pieces.h"

using namespace windfall;

namespace {

constexpr float kWidth = 0.012f, kBall = 1.5f, kFieldOfView = 0.25f;
constexpr int kSize = 96;

/// A ball of dark cones against the sky, `count` of them in no order; `pieces`: told to be pieces.
render::SceneContent ball(int count, bool pieces) {
  RandomSequence random(11);
  const auto draw = [&] { return static_cast<float>(random.uniform(-1, 1)); };
  const auto inBall = [&] {
    vec3 at(2);
    while (glm::dot(at, at) > 1 || glm::dot(at, at) < 0.01f) at = vec3(draw(), draw(), draw());
    return at;
  };
  render::SceneContent content;
  render::Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const vec3 base = kBall * inBall() + vec3(0, 40, 0), along = glm::normalize(inBall());
    const vec3 side = glm::normalize(glm::cross(along, glm::normalize(inBall()))), other = glm::cross(along, side);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int k = 0; k < 4; ++k) {
      render::Vertex vertex;
      const float angle = 2.0943951f * static_cast<float>(k);
      vertex.normal = k < 3 ? side * std::cos(angle) + other * std::sin(angle) : along;
      vertex.position = k < 3 ? base + vertex.normal * (0.5f * kWidth) : base + along * 0.25f;
      vertex.weights[0] = 1;
      mesh.vertices.push_back(vertex);
    }
    for (const std::uint32_t corner : {0u, 1u, 3u, 1u, 2u, 3u, 2u, 0u, 3u, 0u, 2u, 1u}) {
      mesh.indices.push_back(first + corner);
    }
  }
  mesh.materials.push_back({vec4(0.01f, 0.01f, 0.01f, 1), -1, 0.9f, false});
  render::Part part{0, static_cast<std::uint32_t>(mesh.indices.size()), 0};
  if (pieces) part.pieces = static_cast<std::uint32_t>(count), part.width = kWidth;
  mesh.parts.push_back(part);
  content.meshes.push_back(mesh);
  content.trees.push_back({0, 0, 1});
  content.linkCount = 1;
  return content;
}

/// From so far that a piece is `pixels` wide.
render::Picture seen(const render::SceneContent& content, float pixels) {
  test::Stage stage(kSize, kSize);
  REQUIRE(stage.renderer);
  stage.setContent(content);
  stage.view.fieldOfView = kFieldOfView;
  const float distance = kWidth * stage.view.pixelsPerRadian() / pixels;
  stage.view.eye = {0, 40, distance};
  stage.view.target = {0, 40, 0};
  stage.view.toSun = {0, 1, 0.2f};
  const auto slot = stage.renderer->acquire();
  slot.bones[0] = mat4(1);
  stage.renderer->publish(slot);
  return stage.draw();
}

double linear(std::uint8_t value) {
  const double v = value / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// Light that a picture lacks against another, summed.
double darker(const render::Picture& picture, const render::Picture& bare) {
  double sum = 0;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) sum += linear(bare.rgba[i + c]) - linear(picture.rgba[i + c]);
  }
  return sum;
}

}  // namespace

TEST_CASE("fewer pieces are shown the narrower they are, and all of them near by") {
  CHECK(render::piecesShown(1000, 5) == 1000);
  CHECK(render::piecesShown(1000, 0.35f) == 1000);
  CHECK(render::piecesShown(1000, 0.035f) == 115);
  CHECK(render::piecesShown(1000, 0) == 0);
  std::size_t before = 1000;
  for (float width = 1; width > 1e-3f; width *= 0.7f) {
    const std::size_t shown = render::piecesShown(1000, width);
    CHECK(shown <= before);
    before = shown;
  }
}

TEST_CASE("the pieces that are left darken the sky as all of them do") {
  test::Stage probe(8, 8);
  WINDFALL_NEEDS_OPENGL(probe);
  constexpr int kCount = 6000;
  const render::SceneContent whole = ball(kCount, false), thinned = ball(kCount, true);
  render::SceneContent nothing = ball(1, false);
  for (render::Vertex& vertex : nothing.meshes[0].vertices) vertex.position = vec3(0, -5, 0);
  for (const float pixels : {0.5f, 0.2f, 0.1f, 0.06f}) {
    CAPTURE(pixels);
    const render::Picture bare = seen(nothing, pixels), all = seen(whole, pixels), some = seen(thinned, pixels);
    const double wanted = darker(all, bare), got = darker(some, bare);
    CAPTURE(wanted);
    CHECK(wanted > 5);
    CHECK(got / wanted > 0.9);
    CHECK(got / wanted < 1.1);
    if (std::abs(got / wanted - 1) > 0.1) test::keep(some, "render_pieces");
  }
  // Near by nothing is left out and nothing is wider.
  CHECK(seen(whole, 3).rgba == seen(thinned, 3).rgba);
}

TEST_CASE("pieces come and go little by little while the camera moves away") {
  test::Stage probe(8, 8);
  WINDFALL_NEEDS_OPENGL(probe);
  const render::SceneContent whole = ball(6000, false), thinned = ball(6000, true);
  const auto change = [](const render::Picture& a, const render::Picture& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::abs(double(a.rgba[i]) - double(b.rgba[i]));
    return sum / static_cast<double>(a.rgba.size());
  };
  render::Picture before[2] = {seen(whole, 0.2f), seen(thinned, 0.2f)};
  double all = 0, some = 0;
  for (float pixels = 0.196f; pixels > 0.17f; pixels -= 0.004f) {
    render::Picture now[2] = {seen(whole, pixels), seen(thinned, pixels)};
    all += change(before[0], now[0]);
    some += change(before[1], now[1]);
    std::swap(before, now);
  }
  CAPTURE(all);
  CAPTURE(some);
  CHECK(some < 1.3 * all);
}
