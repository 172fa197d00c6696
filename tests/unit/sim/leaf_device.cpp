// Leaves on another device: a device of plain memory, stepped a leaf at a time and in another order, as a GPU would.
#include "sim/leaf_device.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "kernels/leaf_range.h"
#include "kernels/leaf_step.h"
#include "sim/leaf_storage.h"
#include "support/leaf_scene.h"

using namespace windfall;
using namespace windfall::sim;
using namespace windfall::test;

namespace {

/// What a test sees of the device that a field owns.
struct Traffic {
  int uploads = 0, downloads = 0, steps = 0, pictures = 0, counts = 0;
  int stepsUntilFailure = 1 << 30;
  bool dead = false;
};

class PlainDevice final : public LeafDevice {
 public:
  PlainDevice(const LeafStorage& storage, Traffic& traffic)
      : links_(storage.links),
        bytes_(leafBlockBytes(storage.arrays.count, storage.links)),
        memory_(std::make_unique<std::byte[]>(bytes_)),
        traffic_(traffic) {}

  bool upload(const LeafArrays& host, const std::byte* block) override {
    ++traffic_.uploads;
    std::memcpy(memory_.get(), block, bytes_);
    arrays_ = host;
    visitArrays(arrays_, links_, [&](auto*& pointer, std::uint32_t, bool) {
      const std::ptrdiff_t offset = reinterpret_cast<const std::byte*>(pointer) - block;
      pointer = reinterpret_cast<std::remove_reference_t<decltype(pointer)>>(memory_.get() + offset);
    });
    return !traffic_.dead;
  }
  bool download(std::byte* block) override {
    ++traffic_.downloads;
    if (!traffic_.dead) std::memcpy(block, memory_.get(), bytes_);
    return !traffic_.dead;
  }
  bool step(const LeafStep& step) override {
    traffic_.dead = traffic_.dead || traffic_.stepsUntilFailure-- <= 0;
    if (traffic_.dead) return false;
    ++traffic_.steps;
    for (std::uint32_t i = arrays_.count; i-- > 0;) stepLeaf(arrays_, i, step, kLeafBlock);
    std::swap(arrays_.x, arrays_.nextX);
    std::swap(arrays_.y, arrays_.nextY);
    std::swap(arrays_.z, arrays_.nextZ);
    std::swap(arrays_.turn, arrays_.nextTurn);
    return true;
  }
  bool write(const LeafDisplay& display, std::span<LeafInstance> leaves) override {
    ++traffic_.pictures;
    for (std::uint32_t i = 0; i < leaves.size() && !traffic_.dead; ++i) leaves[i] = showLeaf(arrays_, i, display);
    return !traffic_.dead;
  }
  bool counts(LeafTotals& totals, std::span<std::int32_t> lost) override {
    ++traffic_.counts;
    if (traffic_.dead) return false;
    totals = *arrays_.totals;
    std::memcpy(lost.data(), arrays_.lost, lost.size_bytes());
    return true;
  }

 private:
  LeafArrays arrays_{};
  std::uint32_t links_;
  std::size_t bytes_;
  std::unique_ptr<std::byte[]> memory_;
  Traffic& traffic_;
};

void putOnDevice(LeafStage& stage, Traffic& traffic) {
  stage.field.useDevice([&](const LeafStorage& storage) { return std::make_unique<PlainDevice>(storage, traffic); });
}

void run(LeafStage& stage, int steps) {
  for (int k = 0; k < steps; ++k) {
    stage.blow(vec3(6 + 3 * std::sin(3 * static_cast<float>(stage.time)), 0, 1));
    stage.step();
  }
}

bool equal(const std::vector<LeafInstance>& a, const std::vector<LeafInstance>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(LeafInstance)) == 0;
}

}  // namespace

TEST_CASE("leaves on a device go the same ways, and cross the bus only when they are asked for") {
  LeafStage host(leavesOnPole(700, 1)), other(leavesOnPole(700, 1));
  Traffic traffic;
  putOnDevice(other, traffic);
  run(host, 200);
  run(other, 200);
  CHECK(traffic.steps == 200);
  CHECK(traffic.uploads == 1);
  CHECK(traffic.downloads == 0);
  // Counts and pictures do not bring the state.
  CHECK(other.field.counts().attached == host.field.counts().attached);
  CHECK(other.field.counts().airborne + other.field.counts().grounded > 100);
  CHECK(other.field.landed() == host.field.landed());
  CHECK(other.field.fallTimeSum() == host.field.fallTimeSum());
  std::vector<float> lost(1), lostThere(1);
  CHECK(host.field.findLostArea(lost));
  CHECK(other.field.findLostArea(lostThere));
  CHECK(lost == lostThere);
  for (const float alpha : {0.f, 0.4f, 1.f}) CHECK(equal(host.show(alpha), other.show(alpha)));
  CHECK(traffic.counts == 1);
  CHECK(traffic.pictures == 3);
  CHECK(traffic.downloads == 0);

  CHECK(other.field.hash() == host.field.hash());
  CHECK(other.field.save() == host.field.save());
  CHECK(traffic.downloads == 1);
  run(host, 50);
  run(other, 50);
  CHECK(traffic.uploads == 1);
  CHECK(other.field.hash() == host.field.hash());
}

TEST_CASE("what is changed on the host reaches the device") {
  LeafStage host(leavesOnPole(300, 1)), other(leavesOnPole(300, 1));
  Traffic traffic;
  putOnDevice(other, traffic);
  const auto same = [&] {
    run(host, 60);
    run(other, 60);
    return equal(host.show(0.5f), other.show(0.5f)) && host.field.hash() == other.field.hash();
  };
  CHECK(same());
  const std::vector<std::uint8_t> saved = other.field.save();
  CHECK(same());
  REQUIRE(host.field.restore(saved));
  REQUIRE(other.field.restore(saved));
  CHECK(equal(host.show(1), other.show(1)));
  CHECK(same());
  LeafSettings settings = leavesOnPole(300, 1).leaves;
  settings.massPerArea = 0.2f;
  settings.respawn = true;
  CHECK_FALSE(host.field.setSettings(settings));
  CHECK_FALSE(other.field.setSettings(settings));
  CHECK(same());
  settings.count = 500;
  CHECK(host.field.setSettings(settings));
  CHECK(other.field.setSettings(settings));
  CHECK(other.field.isOnDevice());
  CHECK(other.field.size() == 500);
  CHECK(same());
  host.field.reset();
  other.field.reset();
  host.time = other.time = 0;
  CHECK(equal(host.show(1), other.show(1)));
  CHECK(same());
  CHECK(other.field.isOnDevice());
}

TEST_CASE("when the device fails the leaves go on on the host, from what it had last") {
  for (const int stale : {0, 5, 6}) {
    CAPTURE(stale);
    LeafStage host(leavesOnPole(300, 1)), other(leavesOnPole(300, 1));
    Traffic traffic;
    putOnDevice(other, traffic);
    run(host, 100);
    run(other, 100);
    CHECK(other.field.hash() == host.field.hash());
    const LeafCounts before = other.field.counts();
    // So many steps are lost with the device.
    traffic.stepsUntilFailure = stale;
    run(other, stale + 1);
    CHECK_FALSE(other.field.isOnDevice());
    const LeafCounts after = other.field.counts();
    CHECK(after.attached + after.airborne + after.grounded == 300);
    CHECK(after.attached <= before.attached);
    // No leaf has jumped by more than the lost steps.
    const std::vector<LeafInstance> a = host.show(1), b = other.show(1);
    for (std::size_t i = 0; i < a.size(); ++i) {
      CHECK(std::isfinite(b[i].position.x));
      CHECK(glm::length(a[i].position - b[i].position) < 2);
    }
    run(other, 100);
    CHECK(other.field.save().size() == host.field.save().size());
  }
}
