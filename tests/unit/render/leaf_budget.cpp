// Leaves that are small on the screen are thinned, and the crown does not show it.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "kernels/random.h"
#include "support/render_stage.h"
#include "widgets/render/leaf_sort.h"

using namespace windfall;

namespace {

constexpr float kLeafLength = 0.1f, kBall = 1.5f;  // m
constexpr float kFieldOfView = 0.2f;

/// A leaf layer whose blade covers `share` of the picture's width.
render::LeafLayer narrowLayer(float share) {
  render::LeafLayer layer;
  layer.picture = {128, 128, {}};
  for (int i = 0; i < 128 * 128; ++i) {
    const float x = (static_cast<float>(i % 128) + 0.5f) / 128 - 0.5f;
    const std::uint8_t alpha = std::abs(x) < 0.5f * share ? 255 : 0;
    layer.picture.rgba.insert(layer.picture.rgba.end(), {200, 30, 20, alpha});
  }
  layer.pivot = {0.5f, 1};
  layer.extent = {1, 1};
  return layer;
}

/// A ball of leaves against the sky.
struct Crown {
  std::vector<LeafInstance> leaves;

  explicit Crown(std::size_t count) {
    RandomSequence random(7);
    const auto draw = [&] { return static_cast<float>(random.uniform(-1, 1)); };
    while (leaves.size() < count) {
      const vec3 at(draw(), draw(), draw());
      const vec4 turn(draw(), draw(), draw(), draw());
      if (glm::dot(at, at) > 1 || glm::dot(turn, turn) > 1 || glm::dot(turn, turn) < 0.01f) continue;
      leaves.push_back({at * kBall + vec3(0, 40, 0), kLeafLength, glm::normalize(turn), 0, 0, 0, draw()});
    }
  }
};

/// The share of the picture that leaves cover, where leaves would be seen `pixels` long at a height of 64 px, in a
/// picture `finer` times as high.
float covered(const Crown& crown, float share, float pixels, int finer) {
  const int size = 64 * finer;
  test::Stage stage(size, size);
  REQUIRE(stage.renderer);
  render::SceneContent content;
  content.leafCount = crown.leaves.size();
  content.leafLayers.push_back(narrowLayer(share));
  stage.setContent(content);
  const float distance = kLeafLength * 64 / kFieldOfView / pixels;
  stage.view.eye = {0, 40, distance};
  stage.view.target = {0, 40, 0};
  stage.view.fieldOfView = kFieldOfView;
  stage.view.toSun = {0, 1, 0.2f};
  stage.view.quality = render::Quality::Standard;
  // Blue in linear light, where a pixel that is covered by half counts half.
  const auto blueness = [&] {
    const render::Picture picture = stage.draw();
    double sum = 0;
    for (std::size_t i = 2; i < picture.rgba.size(); i += 4) {
      const double value = picture.rgba[i] / 255.0;
      sum += value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    }
    return static_cast<float>(sum / (size * size));
  };
  const auto bare = stage.renderer->acquire();
  for (std::size_t i = 0; i < crown.leaves.size(); ++i) {
    bare.leaves[i] = crown.leaves[i];
    bare.leaves[i].state = static_cast<std::uint32_t>(LeafState::Hidden);
  }
  stage.renderer->publish(bare);
  const float sky = blueness();
  const auto slot = stage.renderer->acquire();
  std::copy(crown.leaves.begin(), crown.leaves.end(), slot.leaves.begin());
  stage.renderer->publish(slot);
  return sky - blueness();
}

}  // namespace

TEST_CASE("narrow and broad leaves still cover the picture where they are a pixel long") {
  {
    test::Stage stage(16, 16);
    WINDFALL_NEEDS_OPENGL(stage);
  }
  const Crown crown(1500);
  // The same crown in a picture so fine that nothing is thinned. The film's curve favours what is bright in a pixel, so
  // that dark leaves count for less there; without their mean alpha narrow ones would be gone.
  for (const float share : {0.9f, 0.3f}) {
    CAPTURE(share);
    const float drawn = covered(crown, share, 1.5f, 1) / covered(crown, share, 1.5f, 4);
    CHECK(drawn > 0.6f);
    CHECK(drawn < 1.1f);
  }
}

namespace {

/// What the sorting lists for these leaves, seen so many pixels long.
struct Listed {
  std::size_t count = 0;
  double area = 0;  ///< of all leaves' area
  std::vector<bool> drawn;
};

Listed listedAt(const std::vector<LeafInstance>& leaves, float pixels, float budget) {
  render::LeafSort sort;
  REQUIRE(bool(sort.compile()));
  REQUIRE(bool(sort.allocate(leaves.size(), std::vector<render::DrawCommand>(render::kLeafKinds))));
  const std::vector<vec4> layer(35, vec4(0));
  const render::Buffer layers =
      render::makeBuffer(static_cast<GLsizeiptr>(layer.size() * sizeof(vec4)), layer.data(), 0);
  const render::Buffer memory =
      render::makeBuffer(static_cast<GLsizeiptr>(leaves.size() * sizeof(LeafInstance)), leaves.data(), 0);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, layers.id());
  render::LeafSight sight;
  sight.eye = {0, 40, 1000};
  sight.pixelsPerRadian = pixels * 1000 / kLeafLength;
  sight.budget = budget;
  sort.run(memory.id(), 0, sight);
  Listed out;
  out.drawn.resize(leaves.size());
  REQUIRE(sort.chunks().size() == 1);
  std::vector<render::DrawCommand> commands(render::kLeafKinds);
  std::vector<GLuint> list(leaves.size());
  glGetNamedBufferSubData(sort.chunks()[0].commands.id(), 0,
                          static_cast<GLsizeiptr>(commands.size() * sizeof(render::DrawCommand)), commands.data());
  glGetNamedBufferSubData(sort.chunks()[0].lists.id(), 0, static_cast<GLsizeiptr>(list.size() * sizeof(GLuint)),
                          list.data());
  for (const render::DrawCommand& command : commands) {
    for (GLuint i = 0; i < command.instances; ++i) {
      const GLuint entry = list[command.baseInstance + i];
      const double scale = (entry >> 21) * 4.0 / 2046;  // as in leaf_layers.glsl
      out.area += scale * scale / static_cast<double>(leaves.size());
      out.drawn[entry & 0x1fffffu] = true;
      ++out.count;
    }
  }
  return out;
}

}  // namespace

TEST_CASE("leaves that the distance thins leave their area to the others") {
  test::Stage stage(16, 16);
  WINDFALL_NEEDS_OPENGL(stage);
  const Crown crown(20000);
  const Listed near = listedAt(crown.leaves, 12, 1e9f), middle = listedAt(crown.leaves, 2, 1e9f),
               far = listedAt(crown.leaves, 0.5f, 1e9f);
  CHECK(near.count == crown.leaves.size());
  CHECK(near.area == doctest::Approx(1).epsilon(0.01));
  CHECK(middle.area == doctest::Approx(1).epsilon(0.03));
  CHECK(far.area == doctest::Approx(1).epsilon(0.05));
  CHECK(static_cast<double>(middle.count) < 0.75 * static_cast<double>(near.count));
  CHECK(static_cast<double>(far.count) < 0.4 * static_cast<double>(near.count));
  // The same leaves go first from every distance, or a moving camera would see them flicker.
  for (std::size_t i = 0; i < far.drawn.size(); ++i) CHECK_FALSE((far.drawn[i] && !middle.drawn[i]));
}

TEST_CASE("a budget of leaves is kept, and so is their area") {
  test::Stage stage(16, 16);
  WINDFALL_NEEDS_OPENGL(stage);
  Crown crown(20000);
  const Listed scarce = listedAt(crown.leaves, 5, 5000);
  CHECK(scarce.count <= 5300);
  CHECK(scarce.area == doctest::Approx(1).epsilon(0.05));
  // What is large on the screen, or in the air, is drawn whatever there is of it.
  CHECK(listedAt(crown.leaves, 30, 5000).count == crown.leaves.size());
  for (LeafInstance& leaf : crown.leaves) leaf.state = static_cast<std::uint32_t>(LeafState::Falling);
  CHECK(listedAt(crown.leaves, 2, 5000).count == crown.leaves.size());
}
