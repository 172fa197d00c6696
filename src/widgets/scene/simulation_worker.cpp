#include "widgets/scene/simulation_worker.h"

#include <algorithm>
#include <utility>

namespace windfall::widgets {

std::string SimulationWorker::makeEngine(EngineRequest request) {
  std::vector<std::uint8_t> before;
  if (request.keepMotion && engine_) before = engine_->save();
  std::unique_ptr<sim::Engine> old = std::move(engine_);
  if (request.keep.empty()) old.reset();
  Result<std::unique_ptr<sim::Engine>> made = sim::Engine::create(std::move(request.scene), request.device);
  if (!made) return made.error().message;
  engine_ = std::move(*made);
  // A motion of another scene is no error: the new one starts at rest.
  if (!before.empty() && engine_->restore(before)) return {};
  if (old) engine_->adopt(*old, request.keep);
  if (request.state.empty()) return {};
  const Status restored = engine_->restore(request.state);
  return restored ? std::string() : restored.error().message;
}

void SimulationWorker::advanceStreaks(double seconds, bool wanted) {
  if (wanted) {
    streaks_.advance(seconds, engine_->windView());
  } else {
    streaks_.clear();
  }
}

FrameResult SimulationWorker::run(FrameTask task) {
  FrameResult result;
  result.slot = task.slot;
  if (task.engine) {
    result.problem = makeEngine(std::move(*task.engine));
    result.madeEngine = engine_ != nullptr;
  }
  if (!engine_) return result;
  result.hasEngine = true;
  if (task.wind) engine_->setWind(*task.wind);
  if (task.leaves) engine_->setLeaves(*task.leaves);
  for (auto& [instance, tree] : task.trees) engine_->setTree(instance, std::move(tree));
  if (task.pull) engine_->setPull(*task.pull);
  const double before = engine_->time();
  switch (task.motion) {
    case Motion::None:
      break;
    case Motion::Advance:
      result.advance = engine_->advance(task.elapsed);
      break;
    case Motion::Step:
      engine_->step();
      break;
    case Motion::Reset:
      engine_->reset();
      streaks_.clear();
      break;
  }
  if (task.motion != Motion::None) advanceStreaks(engine_->time() - before, task.wantStreaks);
  if (task.wantStreaks) result.streaks.assign(streaks_.points().begin(), streaks_.points().end());
  result.linkCount = engine_->linkCount();
  result.leafCount = engine_->leafCount();
  if (task.slot.index >= 0 && task.slot.bones.size() == result.linkCount &&
      task.slot.leaves.size() == result.leafCount) {
    if (task.clip) {
      result.pose = task.clip->pose(task.clipTime);
      engine_->writePosed(result.pose, task.slot.bones, task.slot.leaves);
    } else if (task.wantPose) {
      // The slot is write-only memory, so the pose takes the way round.
      result.pose.resize(result.linkCount);
      engine_->write(result.pose, task.slot.leaves);
      std::copy(result.pose.begin(), result.pose.end(), task.slot.bones.begin());
    } else {
      engine_->write(task.slot.bones, task.slot.leaves);
    }
    result.written = true;
  }
  if (task.wantState) {
    result.state = engine_->save();
    result.hasState = true;
  }
  result.statistics = engine_->statistics();
  result.timers = engine_->timers();
  result.device = engine_->device();
  result.deviceProblem = engine_->deviceProblem();
  return result;
}

std::vector<std::uint8_t> SimulationWorker::saveState() const {
  return engine_ ? engine_->save() : std::vector<std::uint8_t>();
}

double SimulationWorker::time() const { return engine_ ? engine_->time() : 0; }

}  // namespace windfall::widgets
