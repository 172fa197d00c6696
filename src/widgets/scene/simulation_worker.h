// One frame's work of the simulation, apart from threads and windows.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/plant/clip.h"
#include "sim/engine.h"
#include "sim/wind_streaks.h"
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
  std::vector<int> keep;            ///< else: for each tree the one of the engine before that it goes on as, or -1
};

/// A recorded motion that is shown instead of the simulation: the matrices of all links at a time.
struct ClipPlay {
  std::function<std::vector<mat4>(double time)> pose;
};

/// What is to be done, in the order of the members.
struct FrameTask {
  std::optional<EngineRequest> engine;
  std::optional<sim::WindSettings> wind;
  std::optional<sim::LeafSettings> leaves;
  std::map<std::size_t, std::shared_ptr<const sim::Tree>> trees;  ///< by instance
  std::optional<std::optional<sim::Pull>> pull;                   ///< set or let go
  std::shared_ptr<const ClipPlay> clip;                           ///< null: the simulation
  double clipTime = 0;                                            ///< s
  Motion motion = Motion::None;
  double elapsed = 0;      ///< s of real time, for Motion::Advance
  render::FrameSlot slot;  ///< index -1: no picture
  bool wantPose = false;
  bool wantStreaks = false;
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
  std::vector<vec4> streaks;        ///< where wanted
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
  void advanceStreaks(double seconds, bool wanted);

  sim::WindStreaks streaks_;
  std::unique_ptr<sim::Engine> engine_;
};

}  // namespace windfall::widgets
