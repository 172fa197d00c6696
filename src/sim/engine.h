// The scene in motion: trees, wind and leaves in fixed steps, on the CPU or the GPU.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kernels/leaf_instance.h"
#include "kernels/math.h"
#include "kernels/wind.h"
#include "sim/pull.h"
#include "sim/result.h"
#include "sim/settings.h"
#include "sim/tree.h"

namespace windfall::sim {

enum class Device { Auto, Cpu, Cuda };

/// What this machine offers. `name` is for the user ("CPU, 2 threads", "NVIDIA H100").
struct DeviceInfo {
  Device device = Device::Cpu;
  std::string name;
};
/// Every usable device, the CPU first.
std::vector<DeviceInfo> devices();

struct TreeInstance {
  std::shared_ptr<const Tree> tree;
  Placement placement;
};

/// Everything that a run depends on; equal descriptions give equal bits.
struct SceneDescription {
  std::vector<TreeInstance> trees;
  WindSettings wind;
  LeafSettings leaves;
  SolverSettings solver;
  std::uint32_t leafLayers = 1;  ///< layers of the texture array, for leaves that are spawned in the air
  std::uint64_t seed = 1;
};

/// A row of the trace, and what the window shows.
struct Statistics {
  double time = 0;            ///< s
  float tipDisplacement = 0;  ///< m, tip of the highest branch from rest
  float largestAngle = 0;     ///< rad, largest joint rotation now
  double kineticEnergy = 0;   ///< J
  double elasticEnergy = 0;   ///< J
  std::int32_t attached = 0, airborne = 0, grounded = 0;
  double fallTimeSum = 0;  ///< s, over leaves that have landed since the start
  std::int64_t landed = 0;
};

/// Wall clock of the last step, milliseconds.
struct Timers {
  double wind = 0, trees = 0, leaves = 0, output = 0;
};

/// What of a frame's time was simulated.
struct Advance {
  int steps = 0;
  double lost = 0;  ///< s of real time that were dropped because more than 8 steps would have been needed
};

/// A scene being simulated. Not thread-safe: one owner at a time, any thread.
class Engine {
 public:
  static Result<std::unique_ptr<Engine>> create(SceneDescription scene, Device device, int threads = 0);
  virtual ~Engine() = default;

  /// One fixed step. Never fails: a device error is sticky (deviceProblem) and the scene goes on on the CPU.
  virtual void step() = 0;
  /// Adds real time to the accumulator and steps; at most 8 steps a call.
  Advance advance(double seconds);
  /// Back to time 0, the rest pose, all leaves attached.
  virtual void reset() = 0;

  /// Live changes; they take effect with the next step.
  virtual void setWind(const WindSettings& wind) = 0;
  virtual void setLeaves(const LeafSettings& leaves) = 0;
  /// Stiffness, damping, wind response, density or modulus of links changed; the geometry did not.
  /// Refactors in place and keeps the motion.
  virtual void setTree(std::size_t instance, std::shared_ptr<const Tree> tree) = 0;
  /// A hand on one branch; nothing: it lets go. No part of the state.
  virtual void setPull(const std::optional<Pull>& pull) = 0;
  /// Goes on where another engine stands: its time, wind, and the motion of trees that it has too. `from`: an instance
  /// of `before` for each own one, -1 for a new tree, which starts at rest. Leaves start anew.
  virtual void adopt(const Engine& before, std::span<const int> from) = 0;

  /// Links of all instances, in order; `boneMatrices` holds one matrix a link: rest space of its tree to world.
  virtual std::size_t linkCount() const = 0;
  virtual std::size_t leafCount() const = 0;
  /// Writes the display state, interpolated between the last two steps by what is left in the accumulator,
  /// straight into the caller's buffers (OpenGL's mapped memory, say): sizes linkCount() and leafCount().
  virtual void write(std::span<mat4> boneMatrices, std::span<LeafInstance> leaves) = 0;

  /// The same for a pose from elsewhere (a clip): a matrix a link, rest space of its tree to world. Leaves that hang go
  /// with it.
  virtual void writePosed(std::span<const mat4> pose, std::span<mat4> boneMatrices, std::span<LeafInstance> leaves) = 0;
  /// The air as it is now, for streaks; on the host, valid until the next call that changes the engine.
  virtual WindView windView() const = 0;

  virtual Statistics statistics() const = 0;
  virtual Timers timers() const = 0;
  virtual DeviceInfo device() const = 0;
  /// Empty, or one line on what went wrong on the device.
  virtual std::string deviceProblem() const = 0;
  virtual double time() const = 0;

  /// The whole state (time, poses, leaves) as bytes, and back. `restore` refuses bytes of another scene or version.
  virtual std::vector<std::uint8_t> save() const = 0;
  virtual Status restore(std::span<const std::uint8_t> bytes) = 0;
  /// Hash of the state of links and leaves in index order; equal for any number of threads on the CPU.
  virtual std::uint64_t hash() const = 0;

 protected:
  virtual double stepLength() const = 0;
  double accumulator_ = 0;
  double between_ = 1;  ///< what is shown: 0 the step before the last .. 1 the last; `step` sets 1, `advance` the rest
};

}  // namespace windfall::sim
