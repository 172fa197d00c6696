// The leaves of a scene through their life: on the tree, in the air, on the ground (falling_leaves.md; release by
// tree_dynamics.md, 9).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kernels/leaf_instance.h"
#include "kernels/leaf_range.h"
#include "kernels/link_state.h"
#include "kernels/wind.h"
#include "sim/leaf_device.h"
#include "sim/result.h"
#include "sim/settings.h"

namespace windfall::sim {

struct SceneDescription;
struct LeafStorage;

/// Where the leaves are; the sum is always the number of leaves.
struct LeafCounts {
  std::int32_t attached = 0, airborne = 0, grounded = 0;
};

/// All leaves of a scene on the CPU. The engine owns it and calls step() once a fixed step, after the links moved.
/// Not thread-safe from outside; inside it uses OpenMP's threads, with equal bits for any number of them.
class LeafField {
 public:
  /// `settings.count` leaves on the sites of the trees, picked evenly (more leaves than sites: sites are used again
  /// with small offsets), or loose in the air over a disc where `spawnHeight` > 0 or no tree has a site. Links are
  /// numbered through all instances in the scene's order.
  explicit LeafField(const SceneDescription& scene);
  ~LeafField();
  LeafField(LeafField&&) noexcept;
  LeafField& operator=(LeafField&&) noexcept;

  /// From `time` to `time + dt` (s). `links` holds the states at both ends; the ground is y = 0.
  /// No allocation.
  void step(double time, float dt, const LinkView& links, const WindView& wind);
  /// Display state between the last two steps, 0 <= alpha <= 1; `leaves` has size() elements. `links` as in step().
  void write(float alpha, const LinkView& links, std::span<LeafInstance> leaves) const;

  std::size_t size() const;
  LeafCounts counts() const;
  /// Leaves that have landed since the start, and the sum of their fall times in seconds.
  std::int64_t landed() const;
  double fallTimeSum() const;

  /// Sets `area` (m2, one value a link) to what each link has lost; a leaf stands for an equal share of its link's
  /// leafArea, and one that grows again gives its share back. False: nothing changed.
  bool findLostArea(std::span<float> area) const;

  /// All leaves back to where they started, generation 0.
  void reset();
  /// Season, mass and respawning change in place; another count or spawn height starts the leaves anew, on
  /// trees that have all their leafArea (returns true).
  bool setSettings(const LeafSettings& settings);

  /// The whole state as bytes, and back; restore() refuses bytes of another scene or version and then changes nothing.
  std::vector<std::uint8_t> save() const;
  Status restore(std::span<const std::uint8_t> bytes);
  /// Hash of the state of all leaves in index order.
  std::uint64_t hash() const;

  /// Steps and shows the leaves on another device from now on; what the host asks for is fetched when it asks.
  void useDevice(LeafDeviceMaker maker);
  /// Whether they are (still) stepped there.
  bool isOnDevice() const { return device_ != nullptr; }

  /// The arrays themselves.
  const LeafStorage& storage() const;

 private:
  bool stepOnDevice(const LeafStep& step);
  void fetch() const;
  void fetchCounts() const;
  void makeDevice();

  std::unique_ptr<LeafStorage> storage_;
  LeafRange step_;  ///< for this machine's instruction set
  LeafDeviceMaker maker_;
  mutable std::unique_ptr<LeafDevice> device_;
  mutable bool behind_ = false;        ///< the device's state is newer than the host's
  mutable bool countsBehind_ = false;  ///< and so are its totals
  bool ahead_ = false;                 ///< the host's state is newer than the device's
  mutable bool sides_ = false;         ///< LeafStorage::swapped when the host last had the state
};

}  // namespace windfall::sim
