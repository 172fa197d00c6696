#include "sim/leaf_storage.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "kernels/leaf_life.h"
#include "sim/engine.h"
#include "sim/leaf_sites.h"

namespace windfall::sim {

namespace {

constexpr std::size_t kAlign = 64;
std::size_t padded(std::size_t bytes) { return (bytes + kAlign - 1) / kAlign * kAlign; }

/// An attached leaf takes 0.3 s to feel a change of the wind.
float feltDecayOver(float seconds) { return expOf(-seconds / 0.3f); }

/// Loose leaves where no tree can carry them, m.
constexpr float kDefaultHeight = 10;
constexpr float kMedianLeaf = 0.08f;  // length for which petioleStrength() holds, m

}  // namespace

std::size_t leafBlockBytes(std::uint32_t leaves, std::uint32_t links) {
  std::size_t bytes = 0;
  LeafArrays arrays{.count = leaves};
  visitArrays(arrays, links, [&](auto* pointer, std::uint32_t n, bool) { bytes += padded(sizeof(*pointer) * n); });
  return bytes;
}

std::size_t leafStateOffset(std::uint32_t leaves, std::uint32_t links) {
  std::size_t bytes = 0;
  LeafArrays arrays{.count = leaves};
  visitArrays(arrays, links,
              [&](auto* pointer, std::uint32_t n, bool state) { bytes += state ? 0 : padded(sizeof(*pointer) * n); });
  return bytes;
}

LeafArrays leafArraysIn(void* block, std::uint32_t leaves, std::uint32_t links) {
  LeafArrays arrays{.count = leaves};
  auto* at = static_cast<std::byte*>(block);
  visitArrays(arrays, links, [&](auto*& pointer, std::uint32_t n, bool) {
    pointer = reinterpret_cast<std::remove_reference_t<decltype(pointer)>>(at);
    at += padded(sizeof(*pointer) * n);
  });
  return arrays;
}

std::byte* LeafStorage::block() const {
  const auto address = reinterpret_cast<std::uintptr_t>(memory.get());
  return memory.get() + (padded(address) - address);
}

LeafStep LeafStorage::stepAt(double at, float length) const {
  LeafStep step;
  step.seed = seed;
  step.number = stepNumber;
  // About 15 looks a second: gusts change more slowly than that.
  step.interval = static_cast<std::uint32_t>(std::max(1.0f, std::round(1.0f / (15.0f * length))));
  step.time = static_cast<float>(at);
  step.dt = length;
  step.flutterClock = static_cast<float>(std::fmod(at, static_cast<double>(kFlutterPeriod)));
  step.feltDecay = feltDecayOver(length);
  step.strength = petioleStrength(std::clamp(settings.season, 0.0f, 1.0f));
  step.speed = terminalSpeed(settings.massPerArea);
  step.spawnHeight = spawnHeight;
  step.spawnRadius = std::clamp(0.12f * std::sqrt(static_cast<float>(arrays.count)), 2.0f, 100.0f);
  step.spawnCentre = spawnCentre;
  step.respawn = settings.respawn;
  return step;
}

float LeafStorage::feltDecay() const { return feltDecayOver(dt); }

void LeafStorage::swapSides() {
  std::swap(arrays.x, arrays.nextX);
  std::swap(arrays.y, arrays.nextY);
  std::swap(arrays.z, arrays.nextZ);
  std::swap(arrays.turn, arrays.nextTurn);
  swapped = !swapped;
}

LeafStorage makeLeafStorage(const SceneDescription& scene) {
  LeafStorage storage;
  storage.scene = std::make_shared<const SceneDescription>(scene);
  storage.settings = scene.leaves;
  storage.seed = scene.seed;
  if (scene.solver.step > 0) storage.dt = scene.solver.step;
  const auto count = static_cast<std::uint32_t>(std::max(0, scene.leaves.count));
  std::uint32_t links = 0;
  vec3 centre(0);
  for (const TreeInstance& instance : scene.trees) {
    links += static_cast<std::uint32_t>(instance.tree->links.size());
    centre += instance.placement.position / static_cast<float>(scene.trees.size());
  }
  storage.links = links;
  storage.spawnCentre = centre;
  std::vector<LeafPlace> places;
  if (!(scene.leaves.spawnHeight > 0)) places = chooseSites(scene.trees, count, scene.seed);
  const bool loose = places.empty();
  if (loose) storage.spawnHeight = scene.leaves.spawnHeight > 0 ? scene.leaves.spawnHeight : kDefaultHeight;

  const std::size_t bytes = leafBlockBytes(count, links);
  storage.memory = std::make_unique<std::byte[]>(bytes + kAlign);
  storage.arrays = leafArraysIn(storage.block(), count, links);
  const LeafArrays& a = storage.arrays;
  std::vector<std::uint32_t> perLink(links, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t seed = scene.seed;
    a.toughness[i] = expOf(0.5f * clampTo(bellCurve(seed, i, 0, kDrawTough), -2.0f, 2.0f));
    if (loose) {
      const float chord = clampTo(0.07f * expOf(0.3f * bellCurve(seed, i, 0, kDrawLook)), 0.03f, 0.14f);
      a.link[i] = kLoose;
      a.siteTurn[i] = {0, 0, 0, 1};
      a.size[i] = chord / 0.875f;
      a.layer[i] = hash(seed, i, 0, kDrawPlace + 2u) % std::max(1u, scene.leafLayers);
      continue;
    }
    const LeafPlace& place = places[i];
    const LeafSite& site = place.site;
    a.link[i] = place.link;
    a.siteTurn[i] = {site.rotation.x, site.rotation.y, site.rotation.z, site.rotation.w};
    a.siteX[i] = site.position.x, a.siteY[i] = site.position.y, a.siteZ[i] = site.position.z;
    a.size[i] = site.size;
    // A petiole is as thick as its blade needs: strength goes with area, and large leaves tear off no sooner.
    a.toughness[i] *= bladeArea(site.size) / bladeArea(kMedianLeaf);
    a.layer[i] = site.layer;
    ++perLink[place.link];
  }
  storage.leafShare.assign(links, 0);
  std::uint32_t link = 0;
  for (const TreeInstance& instance : scene.trees) {
    for (const Link& each : instance.tree->links) {
      if (perLink[link] > 0) storage.leafShare[link] = each.leafArea / static_cast<float>(perLink[link]);
      ++link;
    }
  }
  resetLeaves(storage);
  return storage;
}

void resetLeaves(LeafStorage& storage) {
  if (storage.swapped) storage.swapSides();
  const std::size_t offset = leafStateOffset(storage.arrays.count, storage.links);
  std::memset(storage.block() + offset, 0, leafBlockBytes(storage.arrays.count, storage.links) - offset);
  storage.time = 0;
  storage.stepNumber = 0;
  const LeafArrays& a = storage.arrays;
  const LeafStep step = storage.stepAt(0, storage.dt);
  for (std::uint32_t i = 0; i < a.count; ++i) {
    a.meta[i] = drawTraits(a, i, step);
    if (a.link[i] == kLoose) {
      startLoose(a, i, step);
      ++a.totals->airborne;
    } else {
      a.clock[i] = kGrow;
      ++a.totals->attached;
    }
  }
}

}  // namespace windfall::sim
