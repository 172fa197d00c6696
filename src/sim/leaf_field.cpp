#include "sim/leaf_field.h"

#include <algorithm>
#include <cmath>

#include "kernels/leaf_display.h"
#include "kernels/leaf_range.h"
#include "kernels/leaf_step.h"
#include "sim/engine.h"
#include "sim/leaf_storage.h"

namespace windfall::sim {

namespace {

/// Leaves a thread takes at once; below twice that, one thread is quicker.
constexpr std::int64_t kChunk = 16 * kLeafBlock;

}  // namespace

LeafField::LeafField(const SceneDescription& scene)
    : storage_(std::make_unique<LeafStorage>(makeLeafStorage(scene))), step_(leafRange(bestLevel())) {}
LeafField::~LeafField() = default;
LeafField::LeafField(LeafField&&) noexcept = default;
LeafField& LeafField::operator=(LeafField&&) noexcept = default;

void LeafField::step(double time, float dt, const LinkView& links, const WindView& wind) {
  LeafStorage& s = *storage_;
  LeafStep step = s.stepAt(time, dt);
  step.links = links;
  step.wind = wind;
  if (!stepOnDevice(step)) {
    const std::int64_t count = s.arrays.count;
#pragma omp parallel for schedule(static) if (count > 2 * kChunk)
    for (std::int64_t first = 0; first < count; first += kChunk) {
      step_(s.arrays, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(std::min(first + kChunk, count)),
            step);
    }
  }
  s.swapSides();
  s.time = time + dt;
  s.dt = dt;
  ++s.stepNumber;
}

void LeafField::write(float alpha, const LinkView& links, std::span<LeafInstance> leaves) const {
  const LeafStorage& s = *storage_;
  LeafDisplay display;
  display.seed = s.seed;
  display.alpha = alpha;
  // Before the first step both sides show the start.
  const double time = std::max(0.0, s.time - (1.0 - alpha) * s.dt);
  display.time = static_cast<float>(time);
  display.flutterClock = static_cast<float>(std::fmod(time, static_cast<double>(kFlutterPeriod)));
  display.feltDecay = s.feltDecay();
  display.season = std::clamp(s.settings.season, 0.0f, 1.0f);
  display.respawn = s.settings.respawn;
  display.links = links;
  if (device_ && !ahead_ && device_->write(display, leaves)) return;
  fetch();
  const auto count = static_cast<std::int64_t>(std::min<std::size_t>(s.arrays.count, leaves.size()));
#pragma omp parallel for schedule(static) if (count > 2 * kChunk)
  for (std::int64_t i = 0; i < count; ++i) {
    leaves[static_cast<std::size_t>(i)] = showLeaf(s.arrays, static_cast<std::uint32_t>(i), display);
  }
}

std::size_t LeafField::size() const { return storage_->arrays.count; }

LeafCounts LeafField::counts() const {
  fetchCounts();
  const LeafTotals& totals = *storage_->arrays.totals;
  return {totals.attached, totals.airborne, totals.grounded};
}

std::int64_t LeafField::landed() const {
  fetchCounts();
  return storage_->arrays.totals->landed;
}

double LeafField::fallTimeSum() const {
  fetchCounts();
  return static_cast<double>(storage_->arrays.totals->fallMicroseconds) * 1e-6;
}

bool LeafField::findLostArea(std::span<float> area) const {
  fetchCounts();
  const LeafStorage& s = *storage_;
  bool changed = false;
  for (std::size_t link = 0; link < s.leafShare.size() && link < area.size(); ++link) {
    const float lost = static_cast<float>(s.arrays.lost[link]) * s.leafShare[link];
    if (lost == area[link]) continue;
    area[link] = lost;
    changed = true;
  }
  return changed;
}

void LeafField::reset() {
  resetLeaves(*storage_);
  behind_ = countsBehind_ = false;
  ahead_ = true;
}

bool LeafField::setSettings(const LeafSettings& settings) {
  fetch();
  ahead_ = true;
  LeafStorage& s = *storage_;
  if (settings.count != s.settings.count || settings.spawnHeight != s.settings.spawnHeight) {
    SceneDescription scene = *s.scene;
    scene.leaves = settings;
    *storage_ = makeLeafStorage(scene);
    makeDevice();
    return true;
  }
  const bool heavier = settings.massPerArea != s.settings.massPerArea;
  const bool regrows = settings.respawn && !s.settings.respawn;
  s.settings = settings;
  const LeafStep step = s.stepAt(s.time, s.dt);
  for (std::uint32_t i = 0; i < s.arrays.count && (heavier || regrows); ++i) {
    const LeafState state = stateOf(s.arrays.meta[i]);
    // A leaf in the air keeps what it has: it would jump.
    if (heavier && state != LeafState::Falling) drawTraits(s.arrays, i, step);
    // Those that have lain long do not vanish all at once.
    if (regrows && state == LeafState::Resting) {
      s.arrays.length[i] = std::max(s.arrays.length[i],
                                    step.time + kVanish + 10 * uniform(s.seed, i, s.arrays.generation[i], kDrawRest));
    }
  }
  return false;
}

}  // namespace windfall::sim
