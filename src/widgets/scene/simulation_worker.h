// One frame's work of the simulation, apart from threads and windows.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/engine.h"
#include "widgets/render/renderer.h"

namespace windfall::widgets {

/// How the simulation moves on in a frame.
enum class Motion { None, Advance, Step, Reset };

/// A scene to be simulated from now on.
struct EngineRequest {
  sim::SceneDescription scene;
  sim::Device device = sim::Device::Auto;
  std::vector<std::uint8_t> state;  ///< of sim::Engine::save; empty: the start
  bool keepMotion = false;          ///< take the state of the engine before, if it fits
};

/// What is to be done, in the order of the members.
struct FrameTask {
  std::optional<EngineRequest> engine;
  std::optional<sim::WindSettings> wind;
  std::optional<sim::LeafSettings> leaves;
  std::map<std::size_t, std::shared_ptr<const sim::Tree>> trees;  ///< by instance
  Motion motion = Motion::None;
  double elapsed = 0;      ///< s of real time, for Motion::Advance
  render::FrameSlot slot;  ///< index -1: no picture
  bool wantPose = false;
  bool wantState = false;
};

struct FrameResult {
  bool hasEngine = false, madeEngine = false;
  std::string problem;  ///< why there is no engine, or why a saved state was not taken up
  std::size_t linkCount = 0, leafCount = 0;
  render::FrameSlot slot;
  bool written = false;  ///< the slot holds a picture; not where its sizes no longer fit
  sim::Advance advance;
  sim::Statistics statistics;
  sim::Timers timers;
  sim::DeviceInfo device;
  std::string deviceProblem;
  std::vector<mat4> pose;           ///< where wanted
  std::vector<std::uint8_t> state;  ///< where wanted
  bool hasState = false;
};

/// Owns the engine; used on one thread at a time.
class SimulationWorker {
 public:
  FrameResult run(FrameTask task);
  /// Empty without an engine.
  std::vector<std::uint8_t> saveState() const;
  /// s; 0 without an engine.
  double time() const;

 private:
  std::string makeEngine(EngineRequest request);

  std::unique_ptr<sim::Engine> engine_;
};

}  // namespace windfall::widgets
