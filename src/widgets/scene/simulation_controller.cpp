#include "widgets/scene/simulation_controller.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace windfall::widgets {
namespace {

QByteArray toQt(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), static_cast<qsizetype>(bytes.size())};
}

}  // namespace

SimulationController::SimulationController(QObject* parent)
    : QObject(parent), onThread_(new QObject), worker_(new SimulationWorker) {
  thread_.setObjectName("simulation");
  onThread_->moveToThread(&thread_);
  thread_.start();
}

SimulationController::~SimulationController() {
  thread_.quit();
  thread_.wait();
}

void SimulationController::setScene(sim::SceneDescription scene, std::shared_ptr<render::SceneContent> content,
                                    const QByteArray& state, bool keepMotion, std::vector<int> keep) {
  hasScene_ = true;
  ++sceneNumber_;
  QByteArray start = state;
  // A scene that was never begun has no motion of its own: what it was to go on from counts.
  if (pending_.engine && !pending_.engine->keepMotion) {
    const EngineRequest& skipped = *pending_.engine;
    if (keepMotion) {
      keepMotion = false;
      keep = skipped.keep;
      start = toQt(skipped.state);
    } else {
      for (int& tree : keep) {
        const auto at = static_cast<std::size_t>(tree);
        tree = tree >= 0 && at < skipped.keep.size() ? skipped.keep[at] : -1;
      }
    }
  }
  pending_.wantState = false;
  scene_ = scene;
  if (content) {
    content_ = std::move(content);
    contentOutdated_ = true;
  }
  // What was to be set live is part of the new scene.
  pending_.wind.reset();
  pending_.leaves.reset();
  pending_.trees.clear();
  pending_.engine = EngineRequest{std::move(scene), device_, {start.begin(), start.end()}, keepMotion, std::move(keep)};
  frameOutdated_ = true;
  pump();
}

void SimulationController::clear() {
  pause();
  sim::SceneDescription nothing;
  nothing.leaves.count = 0;
  setScene(std::move(nothing), std::make_shared<render::SceneContent>());
  hasScene_ = false;
}

void SimulationController::setWind(const sim::WindSettings& wind) {
  scene_.wind = wind;
  if (pending_.engine) {
    pending_.engine->scene.wind = wind;
  } else {
    pending_.wind = wind;
  }
  frameOutdated_ = true;
  emit redrawWanted();
}

void SimulationController::setLeaves(const sim::LeafSettings& leaves) {
  scene_.leaves = leaves;
  if (pending_.engine) {
    pending_.engine->scene.leaves = leaves;
  } else {
    pending_.leaves = leaves;
  }
  frameOutdated_ = true;
  emit redrawWanted();
}

void SimulationController::setTree(std::size_t instance, std::shared_ptr<const sim::Tree> tree) {
  if (instance >= scene_.trees.size()) return;
  scene_.trees[instance].tree = tree;
  if (pending_.engine) {
    pending_.engine->scene.trees[instance].tree = std::move(tree);
  } else {
    pending_.trees[instance] = std::move(tree);
  }
  frameOutdated_ = true;
  emit redrawWanted();
}

void SimulationController::setPull(const std::optional<sim::Pull>& pull) {
  pending_.pull = pull;
  frameOutdated_ = true;
  emit redrawWanted();
}

void SimulationController::setClip(std::shared_ptr<const ClipPlay> clip) {
  clip_ = std::move(clip);
  clipTime_ = 0;
  frameOutdated_ = true;
  emit redrawWanted();
}

void SimulationController::setStreaks(bool on) {
  if (on == streaks_) return;
  streaks_ = on;
  frameOutdated_ = true;
  emit redrawWanted();
}

void SimulationController::setDevice(sim::Device device) {
  if (device == device_) return;
  device_ = device;
  if (!hasScene_) return;
  if (pending_.engine) {
    pending_.engine->device = device;
  } else {
    setScene(scene_, nullptr, {}, true);
  }
}

void SimulationController::play() {
  if (playing_ || !hasScene_) return;
  playing_ = true;
  lostTime_ = 0;
  clock_.start();
  emit playingChanged(true);
  emit redrawWanted();
}

void SimulationController::pause() {
  if (!playing_) return;
  playing_ = false;
  pending_.wantState = true;
  frameOutdated_ = true;
  emit playingChanged(false);
  emit redrawWanted();
}

void SimulationController::step() {
  pause();
  if (!hasScene_) return;
  pending_.motion = Motion::Step;
  pending_.wantState = true;
  frameOutdated_ = true;
  emit redrawWanted();
}

void SimulationController::reset() {
  pending_.motion = Motion::Reset;
  pending_.wantState = !playing_;
  frameOutdated_ = true;
  lostTime_ = 0;
  emit redrawWanted();
}

void SimulationController::requestPose(std::function<void(const std::vector<mat4>&)> callback) {
  if (!hasScene_) return;
  poseCallbacks_.push_back(std::move(callback));
  frameOutdated_ = true;
  emit redrawWanted();
}

void SimulationController::setPoseWatched(bool watched) {
  poseWatched_ = watched;
  if (!watched) return;
  frameOutdated_ = true;
  emit redrawWanted();
}

std::optional<SimulationController::State> SimulationController::saveState() {
  if (!hasScene_ || pending_.engine) return std::nullopt;
  State state;
  QMetaObject::invokeMethod(
      onThread_.get(),
      [&] {
        state.time = worker_->time();
        if (state.time > 0) state.bytes = toQt(worker_->saveState());
      },
      Qt::BlockingQueuedConnection);
  return state;
}

void SimulationController::setView(vec3 toSun, float sunStrength) {
  toSun_ = toSun;
  sunStrength_ = sunStrength;
  emit redrawWanted();
}

void SimulationController::setDetail(float tolerance, float cardsBelow) {
  tolerance_ = tolerance;
  cardsBelow_ = cardsBelow;
  emit redrawWanted();
}

void SimulationController::setHighlighted(std::vector<std::uint32_t> links) {
  highlighted_ = std::move(links);
  emit redrawWanted();
}

void SimulationController::setLinkColors(std::vector<std::uint32_t> colors) {
  if (colors == linkColors_) return;
  linkColors_ = std::move(colors);
  emit redrawWanted();
}

bool SimulationController::wantsFrame() const { return hasScene_ && (playing_ || frameOutdated_); }

bool SimulationController::isSettled() const {
  const bool isShown = !contentOutdated_ && !ready_ && !frameOutdated_;
  return !inFlight_ && !pending_.engine && (isShown || !hasScene_);
}

FrameTask SimulationController::takePending() { return std::exchange(pending_, {}); }

/// An engine can be made without a picture; everything else waits for the viewport to draw.
void SimulationController::pump() {
  if (inFlight_ || !pending_.engine) return;
  FrameTask task;
  task.engine = std::exchange(pending_.engine, std::nullopt);
  post(std::move(task));
}

void SimulationController::post(FrameTask task) {
  inFlight_ = true;
  flightGeneration_ = generation_;
  flightScene_ = sceneNumber_;
  auto shared = std::make_shared<FrameTask>(std::move(task));
  QMetaObject::invokeMethod(
      onThread_.get(),
      [this, shared] {
        auto result = std::make_shared<FrameResult>(worker_->run(std::move(*shared)));
        QMetaObject::invokeMethod(
            this, [this, result] { finish(std::move(*result)); }, Qt::QueuedConnection);
      },
      Qt::QueuedConnection);
}

void SimulationController::finish(FrameResult result) {
  inFlight_ = false;
  last_ = std::move(result);
  lostTime_ += last_.advance.lost;
  if (last_.hasEngine && content_ && content_->leafCount != last_.leafCount) {
    content_->leafCount = last_.leafCount;
    contentOutdated_ = true;
  }
  if (last_.written && flightGeneration_ == generation_) {
    ready_ = last_.slot;
  } else if (last_.hasEngine) {
    frameOutdated_ = true;
  }
  if (last_.madeEngine && hasScene_) pending_.wantState = pending_.wantState || !playing_;
  if (!last_.pose.empty()) {
    for (auto& callback : std::exchange(poseCallbacks_, {})) callback(last_.pose);
  }
  const QString text = QString::fromStdString(last_.problem.empty() ? last_.deviceProblem : last_.problem);
  if (text != shownProblem_) {
    shownProblem_ = text;
    if (!text.isEmpty()) emit problem(text);
  }
  if (last_.hasState && !playing_ && flightScene_ == sceneNumber_) {
    emit stopped(last_.statistics.time, last_.statistics.time > 0 ? toQt(last_.state) : QByteArray());
  }
  emit reported();
  pump();
  emit redrawWanted();
}

void SimulationController::prepare(render::Renderer& renderer) {
  if (contentOutdated_ && !inFlight_ && content_ && last_.hasEngine && !pending_.engine) {
    ++generation_;
    ready_.reset();
    const Status uploaded = renderer.setContent(*content_);
    if (!uploaded) emit problem(QString::fromStdString(uploaded.error().message));
    contentOutdated_ = false;
    frameOutdated_ = true;
  }
  if (ready_) renderer.publish(*std::exchange(ready_, std::nullopt));
  if (inFlight_ || contentOutdated_ || pending_.engine || !wantsFrame()) return;
  const render::FrameSlot slot = renderer.acquire();
  if (slot.index < 0) return;
  FrameTask task = takePending();
  task.slot = slot;
  task.wantPose = poseWatched_ || !poseCallbacks_.empty();
  task.wantStreaks = streaks_;
  task.clip = clip_;
  if (playing_ && task.motion == Motion::None) {
    const double elapsed = static_cast<double>(clock_.nsecsElapsed()) * 1e-9;
    if (clip_) {
      clipTime_ += std::min(elapsed, 0.25);
    } else {
      task.motion = Motion::Advance;
      task.elapsed = elapsed;
    }
  }
  task.clipTime = clipTime_;
  clock_.start();
  frameOutdated_ = false;
  post(std::move(task));
}

void SimulationController::describe(render::View& view) const {
  view.toSun = toSun_;
  view.season = scene_.leaves.season;
  view.sunStrength = sunStrength_;
  view.tolerance = tolerance_;
  view.cardsBelow = cardsBelow_;
  view.time = static_cast<float>(last_.statistics.time);
  const vec3 along(scene_.wind.direction.x, 0, scene_.wind.direction.z);
  const float length = glm::length(along);
  view.wind = length > 0 ? along * (scene_.wind.speed / length) : vec3(0);
  view.highlighted = highlighted_;
  view.linkColors = linkColors_;
  if (streaks_) {
    view.streaks = last_.streaks;
    view.streakPoints = sim::WindStreaks::kPoints;
  }
}

void SimulationController::release() {
  if (inFlight_)
    QMetaObject::invokeMethod(
        onThread_.get(), [] {}, Qt::BlockingQueuedConnection);
  ++generation_;
  ready_.reset();
  contentOutdated_ = content_ != nullptr;
  frameOutdated_ = true;
}

}  // namespace windfall::widgets
