// Adaptive detail: the GPU chooses as the CPU does, shared rings are the same to the bit, and nothing jumps.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <map>

#include "support/detail_scene.h"
#include "support/render_stage.h"
#include "widgets/render/detail_stage.h"
#include "widgets/render/shader_program.h"

using namespace windfall;
using Target = render::DetailPass::Target;
using Chooser = render::DetailPass::Chooser;

namespace {

/// Evaluates the vertex shader's corners in a compute shader.
class Corners {
 public:
  /// A vertex of a run's ring: ring, place around, level of the grid's sides.
  struct Question {
    std::uint32_t ring = 0, around = 0, level = 0, unused = 0;
  };

  Corners() {
    const auto shader = render::compileShader(GL_COMPUTE_SHADER, "corners.comp",
                                              "#define EVALUATED\n#include \"detail_vertex.glsl\"\n"
                                              "layout(local_size_x = 64) in;\n"
                                              "layout(std430, binding = 13) readonly buffer Asked { uvec4 asked[]; };\n"
                                              "layout(std430, binding = 12) writeonly buffer Told { vec4 told[]; };\n"
                                              "void main() {\n"
                                              "  uint i = gl_GlobalInvocationID.x;\n"
                                              "  if (i >= uint(asked.length())) return;\n"
                                              "  cell = uvec4(0u, asked[i].y, 1u, asked[i].z);\n"
                                              "  run = uvec3(asked[i].x);\n"
                                              "  told[i] = vec4(corner().position, 0.0);\n"
                                              "}\n",
                                              {});
    REQUIRE_MESSAGE(bool(shader), shader.error().message);
    program_ = render::Program(glCreateProgram());
    glAttachShader(program_.id(), shader->id());
    glLinkProgram(program_.id());
  }

  std::vector<vec4> ask(const render::DetailPass& pass, const std::vector<Question>& questions) const {
    const auto bytes = static_cast<GLsizeiptr>(questions.size() * sizeof(Question));
    const render::Buffer asked = render::makeBuffer(bytes, questions.data(), 0);
    const render::Buffer told = render::makeBuffer(bytes, nullptr, 0);
    pass.bindRings(Target::Picture);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 13, asked.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 12, told.id());
    glUseProgram(program_.id());
    glDispatchCompute(static_cast<GLuint>(questions.size() / 64 + 1), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    std::vector<vec4> answers(questions.size());
    glGetNamedBufferSubData(told.id(), 0, bytes, answers.data());
    return answers;
  }

 private:
  render::Program program_;
};

struct DetailTest {
  test::Stage stage{160, 90};
  std::unique_ptr<render::DetailStage> detail;
  render::SceneContent content = test::wavyScene(4);
  std::vector<mat4> bones = test::wavyPose(content, 0.4f);
  render::View view;

  DetailTest() {
    if (!stage.renderer) return;
    auto made = render::DetailStage::create(160, 90);
    REQUIRE_MESSAGE(bool(made), made.error().message);
    detail = std::move(*made);
    REQUIRE(bool(detail->setContent(content)));
    view.height = 720;  // chosen as for a larger picture
    view.width = 1280;
    view.fieldOfView = 0.7f;
  }

  void lookFrom(float distance) {
    view.eye = {3, 1.5f, distance};
    view.target = {2.5f, 1.5f, 0};
  }
  void choose(Chooser chooser) {
    render::DetailPass& pass = detail->adaptive();
    pass.setChooser(chooser);
    // The stage binds the bones; its own choice is for its small picture.
    detail->draw(view, bones, true);
    pass.choose(Target::Picture, render::detailCamera(view, view.tolerance), bones);
  }
  std::vector<std::pair<std::uint32_t, DetailRun>> chosen() {
    std::vector<std::pair<std::uint32_t, DetailRun>> out;
    const auto counts = detail->counts();
    const auto runs = detail->adaptive().runs(Target::Picture);
    std::size_t at = 0;
    for (std::uint32_t g = 0; g < kDetailGrids; ++g) {
      for (std::uint32_t i = 0; i < counts.runs[g]; ++i) out.emplace_back(g, runs[at++]);
    }
    return out;
  }
};

auto sorted(std::vector<std::pair<std::uint32_t, DetailRun>> runs) {
  std::vector<std::array<std::uint32_t, 3>> out;
  for (const auto& [grid, run] : runs) out.push_back({grid, run.ringA, run.ringB});
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

TEST_CASE("the GPU chooses the runs and grids that the CPU chooses") {
  DetailTest test;
  WINDFALL_NEEDS_OPENGL(test.stage);
  std::size_t most = 0, least = 1u << 30;
  for (const float distance : {1.5f, 3.0f, 6.0f, 14.0f, 40.0f, 160.0f}) {
    CAPTURE(distance);
    test.lookFrom(distance);
    test.choose(Chooser::Cpu);
    const auto cpu = sorted(test.chosen());
    const auto cpuRings = test.detail->adaptive().rings(Target::Picture);
    test.choose(Chooser::Gpu);
    const auto gpu = sorted(test.chosen());
    const auto gpuRings = test.detail->adaptive().rings(Target::Picture);
    REQUIRE_FALSE(cpu.empty());
    CHECK(cpu == gpu);
    most = std::max(most, cpu.size());
    least = std::min(least, cpu.size());
    for (const auto& run : cpu) {
      for (const std::uint32_t ring : {run[1], run[2]}) {
        REQUIRE(cpuRings[ring].position == gpuRings[ring].position);
        REQUIRE(std::ceil(cpuRings[ring].level) == std::ceil(gpuRings[ring].level));
        REQUIRE(cpuRings[ring].radius == doctest::Approx(gpuRings[ring].radius).epsilon(1e-4));
      }
    }
  }
  CHECK(most > 4 * least);
}

TEST_CASE("runs that share a ring have the same vertices on it, to the bit") {
  DetailTest test;
  WINDFALL_NEEDS_OPENGL(test.stage);
  const Corners corners;
  std::size_t shared = 0, unlike = 0;
  for (const float distance : {1.2f, 2.5f, 7.0f, 25.0f}) {
    test.lookFrom(distance);
    test.choose(Chooser::Cpu);
    const auto chosen = test.chosen();
    std::vector<Corners::Question> questions;
    for (const auto& [grid, run] : chosen) {
      const std::uint32_t level = grid / kDetailAxial;
      for (const std::uint32_t ring : {run.ringA, run.ringB}) {
        for (std::uint32_t j = 0; j < (3u << level); ++j) questions.push_back({ring, j, level, 0});
      }
    }
    const std::vector<vec4> answers = corners.ask(test.detail->adaptive(), questions);
    // A ring's vertices, as each run sees them; finer grids repeat some.
    std::map<std::uint32_t, std::vector<std::array<float, 3>>> seen;
    std::size_t at = 0;
    for (const auto& [grid, run] : chosen) {
      for (const std::uint32_t ring : {run.ringA, run.ringB}) {
        std::vector<std::array<float, 3>> own;
        for (std::uint32_t j = 0; j < (3u << (grid / kDetailAxial)); ++j, ++at) {
          own.push_back({answers[at].x, answers[at].y, answers[at].z});
        }
        std::sort(own.begin(), own.end());
        own.erase(std::unique(own.begin(), own.end()), own.end());
        const auto [found, isNew] = seen.try_emplace(ring, own);
        if (isNew) continue;
        ++shared;
        unlike += found->second == own ? 0 : 1;
      }
    }
  }
  CHECK(shared > 300);
  CHECK(unlike == 0);
}

TEST_CASE("no vertex of a ring jumps when the camera moves across a change of level") {
  DetailTest test;
  WINDFALL_NEEDS_OPENGL(test.stage);
  const Corners corners;
  const std::uint32_t ringCount = static_cast<std::uint32_t>(test.content.details[0]->rings.size());
  float worst = 0;
  int changes = 0;
  const float focal = 720 / (2 * std::tan(0.35f));
  test.lookFrom(5);
  test.choose(Chooser::Gpu);
  const auto atRest = test.detail->adaptive().rings(Target::Picture);
  const float scale = render::detailCamera(test.view, test.view.tolerance).scale;
  for (std::uint32_t crossing = 0; crossing < 24; ++crossing) {
    // To and fro over the distance at which a ring changes its level.
    const std::uint32_t chosen = (crossing * 37) % ringCount;
    const DetailRing& ring = test.content.details[0]->rings[chosen];
    const float distance = detail::kSagitta[crossing % 4] * ring.radius * scale;
    if (distance < 0.3f) continue;
    std::vector<std::vector<vec4>> places;
    std::vector<SkinnedRing> rings[2];
    for (const float share : {0.99995f, 1.00005f}) {
      test.view.eye = atRest[chosen].position + vec3(0, 0, distance * share);
      test.view.target = atRest[chosen].position;
      // The GPU skins every ring, chosen or not.
      test.choose(Chooser::Gpu);
      rings[places.size()] = test.detail->adaptive().rings(Target::Picture);
      std::vector<Corners::Question> questions;
      for (std::uint32_t r = 0; r < ringCount; ++r) {
        for (std::uint32_t j = 0; j < 48; ++j) questions.push_back({r, j, 4, 0});
      }
      places.push_back(corners.ask(test.detail->adaptive(), questions));
    }
    for (std::size_t i = 0; i < places[0].size(); ++i) {
      const float far = std::max(0.3f, glm::length(vec3(places[0][i]) - test.view.eye));
      worst = std::max(worst, glm::length(vec3(places[0][i] - places[1][i])) * focal / far);
    }
    changes += std::ceil(rings[0][chosen].level) != std::ceil(rings[1][chosen].level) ? 1 : 0;
  }
  CAPTURE(changes);
  CHECK(changes > 8);
  CHECK(worst < 0.02f);
}

TEST_CASE("wood whose colour changes along it is nowhere darker than its darkest colour in shadow") {
  test::Stage stage(320, 180);
  WINDFALL_NEEDS_OPENGL(stage);
  render::SceneContent content = test::wavyScene(12);
  auto mesh = std::make_shared<DetailMesh>(*content.details[0]);
  for (DetailRing& ring : mesh->rings) ring.tint = ring.v < 10 ? 0xffffffffu : 0xff000000u;
  content.details[0] = mesh;
  content.meshes[0].materials.push_back({vec4(0.9f, 0.9f, 0.9f, 1), -1, 0.9f, false});
  stage.setContent(content);
  stage.view.eye = {11, 2, 140};
  stage.view.target = {11, 2, 0};
  stage.view.fieldOfView = 0.5f;
  int black = 0;
  render::Picture picture;
  for (int step = 0; step < 12; ++step) {
    const auto slot = stage.renderer->acquire();
    const std::vector<mat4> bones = test::wavyPose(content, 0.05f * static_cast<float>(step));
    std::copy(bones.begin(), bones.end(), slot.bones.begin());
    stage.renderer->publish(slot);
    picture = stage.draw();
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
      if (std::min({picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2]}) < 8) ++black;
    }
  }
  CHECK(black == 0);
  if (black > 0) test::keep(picture, "render_slivers");
}

TEST_CASE("adaptive meshes that name what they do not have are refused") {
  test::Stage stage(16, 16);
  WINDFALL_NEEDS_OPENGL(stage);
  const auto refusal = [&](void (*spoil)(DetailMesh&)) {
    render::SceneContent content = test::wavyScene(1);
    DetailMesh mesh = *content.details[0];
    spoil(mesh);
    content.details[0] = std::make_shared<DetailMesh>(mesh);
    const Status status = stage.renderer->setContent(content);
    return status ? std::string() : status.error().message;
  };
  CHECK(refusal([](DetailMesh&) {}).empty());
  CHECK(refusal([](DetailMesh& m) { m.entries[3].ringB = 1u << 20; }) ==
        "an adaptive mesh names a ring that is not there");
  CHECK(refusal([](DetailMesh& m) { m.rings[3].link = m.links; }) == "an adaptive mesh names a link that is not there");
  CHECK(refusal([](DetailMesh& m) { m.chains[1].entryCount = 1u << 30; }) ==
        "an adaptive mesh names a run that is not there");
}
