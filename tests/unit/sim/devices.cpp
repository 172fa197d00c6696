// One body of tests for every device; a device that this machine lacks is skipped by its name.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "kernels/link_air.h"
#include "kernels/link_sweep.h"
#include "sim/engine.h"
#include "sim/sample_tree.h"
#include "sim/tree_field.h"
#include "sim/wind.h"

using namespace windfall;
using namespace windfall::sim;

namespace {

bool present(Device device) {
  for (const DeviceInfo& info : devices()) {
    if (info.device == device) return true;
  }
  MESSAGE("skipped: this machine has no CUDA device");
  return false;
}

SceneDescription forest() {
  SceneDescription description;
  auto tree = std::make_shared<Tree>(sampleTree());
  description.trees.push_back({tree, {}});
  description.trees.push_back({tree, {vec3(8, 0, 3), 1}});
  description.wind.speed = 9;
  description.leaves.count = 0;
  return description;
}

}  // namespace

TEST_CASE("every device moves the trees as the CPU does") {
  for (const Device device : {Device::Cpu, Device::Cuda}) {
    if (!present(device)) continue;
    const auto reference = Engine::create(forest(), Device::Cpu, 1), engine = Engine::create(forest(), device, 2);
    REQUIRE(reference);
    REQUIRE(engine);
    CHECK((*engine)->device().device == device);
    for (int i = 0; i < 120; ++i) {
      (*reference)->step();
      (*engine)->step();
    }
    CHECK((*engine)->deviceProblem().empty());
    const Statistics a = (*reference)->statistics(), b = (*engine)->statistics();
    CHECK(a.tipDisplacement == doctest::Approx(b.tipDisplacement).epsilon(1e-4));
    CHECK(a.elasticEnergy == doctest::Approx(b.elasticEnergy).epsilon(1e-3));
    std::vector<mat4> first((*reference)->linkCount()), second(first.size());
    (*reference)->write(first, {});
    (*engine)->write(second, {});
    float farthest = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      for (int k = 0; k < 4; ++k) farthest = std::max(farthest, glm::length(first[i][k] - second[i][k]));
    }
    CHECK(farthest < 1e-4f);
  }
}

TEST_CASE("every device lets leaves go and fall as the CPU does") {
  for (const Device device : {Device::Cpu, Device::Cuda}) {
    if (!present(device)) continue;
    SceneDescription scene = forest();
    scene.leaves.count = 5000;
    scene.leaves.season = 1;
    scene.wind.fans.push_back({});
    const auto reference = Engine::create(scene, Device::Cpu, 1), engine = Engine::create(scene, device, 2);
    REQUIRE(reference);
    REQUIRE(engine);
    for (int i = 0; i < 240; ++i) {
      (*reference)->step();
      (*engine)->step();
    }
    CHECK((*engine)->deviceProblem().empty());
    const Statistics a = (*reference)->statistics(), b = (*engine)->statistics();
    CHECK(a.attached + a.airborne + a.grounded == 5000);
    CHECK(b.attached + b.airborne + b.grounded == 5000);
    CHECK(a.attached < 4500);
    // A rounding may let a leaf go a step later.
    CHECK(std::abs(a.attached - b.attached) <= 25);
    CHECK(static_cast<double>(b.landed) == doctest::Approx(static_cast<double>(a.landed)).epsilon(0.05));
    std::vector<mat4> bones((*reference)->linkCount());
    std::vector<LeafInstance> first(5000), second(5000);
    (*reference)->write(bones, first);
    (*engine)->write(bones, second);
    int apart = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      apart += glm::length(first[i].position - second[i].position) > 1e-3f ? 1 : 0;
    }
    CHECK(apart <= 50);
    // The state of one goes on on the other.
    REQUIRE((*reference)->restore((*engine)->save()));
    CHECK((*reference)->hash() == (*engine)->hash());
  }
}

namespace {

/// A step as the GPU makes it: with a slot at a time, parents gathering from their children.
template <class Solver>
void sweep(TreeField& field, const LinkSlots<float>& slots, const LinkChildren& children) {
  const LinkStep<float> step = field.stepParameters();
  const std::vector<Part>& parts = field.slots().parts;
  const auto up = [&](const Part& part) {
    for (std::uint32_t s = part.end * kSlotBlock; s-- > part.begin * kSlotBlock;)
      slotUp<Solver>(slots, children, step, s);
  };
  const auto down = [&](const Part& part) {
    for (std::uint32_t s = part.begin * kSlotBlock; s < part.end * kSlotBlock; ++s) slotDown<Solver>(slots, step, s);
  };
  for (std::size_t p = 1; p < parts.size(); ++p) up(parts[p]);
  for (std::size_t p = 0; p < 1; ++p) up(parts[p]);
  for (const Part& part : parts) down(part);
}

void stepSlotBySlot(TreeField& field, const WindView& wind) {
  const std::span<const float> given = field.outside();
  const std::vector<float> outside(given.begin(), given.end());
  AlignedVector<float> state(field.slotState().begin(), field.slotState().end()), air(field.slots().link.size() * 3);
  AlignedVector<LinkState> now(field.rows().begin(), field.rows().end());
  AlignedVector<float> sums(std::size_t{field.slots().rows} * field.sumRow()), moves(field.slots().rows * kMoveRow);
  const Gathering gathering = gatheringOf(field.slots(), field.parents());
  LinkSlots<float> slots = field.view();
  slots.before = reinterpret_cast<const float*>(field.rows().data());
  slots.after = reinterpret_cast<float*>(now.data());
  slots.state = state.data();
  slots.sums = sums.data();
  slots.moves = moves.data();
  slots.air = air.data();
  slots.outside = outside.empty() ? nullptr : outside.data();
  for (std::uint32_t s = 0; s < field.slots().link.size(); ++s) slotAir(slots, wind, s, air.data());
  const LinkChildren children{gathering.begin.data(), gathering.rows.data()};
  switch (field.settings().method) {
    case TreeMethod::Coupled:
      sweep<CoupledSolver>(field, slots, children);
      break;
    case TreeMethod::Forces:
      sweep<ForcesSolver>(field, slots, children);
      break;
    default:
      if (usesAxes(field.settings())) {
        sweep<AxisSolver>(field, slots, children);
      } else {
        sweep<ModalSolver>(field, slots, children);
      }
  }
  field.takeStep(state, now);
}

}  // namespace

TEST_CASE("the automatic choice always works, and a missing device is named") {
  const auto automatic = Engine::create(forest(), Device::Auto);
  REQUIRE(automatic);
  CHECK(devices().front().device == Device::Cpu);
  if (devices().size() == 1) {
    CHECK((*automatic)->device().device == Device::Cpu);
    const auto cuda = Engine::create(forest(), Device::Cuda);
    REQUIRE_FALSE(cuda);
    CHECK(cuda.error().message.rfind("no CUDA device: ", 0) == 0);
  }
}

// Compiled here for the plainest instruction set, while the loops run on the best one of this machine.
TEST_CASE("a pass slot by slot, as on the GPU, gives the bits of the wide loops") {
  const SceneDescription description = forest();
  WindField wind(vec3(-10, 0, -10), vec3(15, 12, 15), description.wind, 1);
  wind.advance(1);
  for (const std::uint32_t width : {16u, 128u}) {
    FactorSettings settings;
    settings.windSpeed = 9;
    for (const TreeMethod method :
         {TreeMethod::Coupled, TreeMethod::Analytic, TreeMethod::Forces, TreeMethod::Literal}) {
      settings.method = method;
      settings.axisMotion = width == 16;
      const FieldCut cut{200, 400, width};
      TreeField field(description.trees, settings, 1, cut), single(description.trees, settings, 1, cut);
      for (int i = 0; i < 30; ++i) {
        const LinkForce pull{40, vec3(3, 1, 2), vec3(0.1f, 0, 0)};
        field.setForces({&pull, 1});
        single.setForces({&pull, 1});
        field.step(wind.view());
        stepSlotBySlot(single, wind.view());
      }
      CAPTURE(std::string(nameOf(method)));
      CAPTURE(width);
      CHECK(field.largestAngle() > 0.001f);
      CHECK(field.largestAngle() < 2);
      for (std::size_t i = 0; i < field.size(); ++i) {
        CAPTURE(i);
        CAPTURE(field.current()[i].rotation.x);
        CAPTURE(single.current()[i].rotation.x);
        REQUIRE(field.current()[i].position == single.current()[i].position);
        REQUIRE(field.current()[i].rotation == single.current()[i].rotation);
      }
    }
  }
}

TEST_CASE("every instruction set gives the same bits") {
  const SceneDescription description = forest();
  WindField wind(vec3(-10, 0, -10), vec3(15, 12, 15), description.wind, 1);
  wind.advance(1);
  const LinkLoopsList list = everyLinkLoops();
  CHECK(list.count >= 1);
  for (const TreeMethod method : {TreeMethod::Coupled, TreeMethod::Analytic, TreeMethod::Forces}) {
    FactorSettings settings;
    settings.windSpeed = 9;
    settings.method = method;
    TreeField start(description.trees, settings, 1);
    for (int i = 0; i < 5; ++i) start.step(wind.view());
    std::vector<float> first;
    for (int k = 0; k < list.count; ++k) {
      TreeField field(description.trees, settings, 1);
      field.setState(start.state(), start.previous(), start.current());
      field.sampleAir(wind.view());
      const LinkSlots<float> view = field.view();
      const LinkPasses passes = method == TreeMethod::Coupled    ? list.all[k]->coupled
                                : method == TreeMethod::Analytic ? list.all[k]->modal
                                                                 : list.all[k]->forces;
      // All parts but the top, whose links stay behind: what matters is that all do the same.
      for (const Part& part : field.slots().parts) passes.up(view, field.stepParameters(), part.begin, part.end);
      for (const Part& part : field.slots().parts) passes.down(view, field.stepParameters(), part.begin, part.end);
      const std::vector<float> state = field.state();
      if (first.empty()) first = state;
      CHECK(std::memcmp(first.data(), state.data(), state.size() * sizeof(float)) == 0);
    }
  }
}
