// The simulation as the window uses it: runs on a thread of its own and hands its frames to a viewport.
#pragma once

#include <QByteArray>
#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <QThread>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "widgets/render/content.h"
#include "widgets/scene/simulation_worker.h"
#include "widgets/viewport/frame_source.h"

namespace windfall::widgets {

/// One frame is in work at most: while the viewport draws it, the next one is computed. The GUI thread waits for the
/// simulation only when the renderer goes away or the state is saved. Live on the GUI thread.
class SimulationController : public QObject, public FrameSource {
  Q_OBJECT
 public:
  explicit SimulationController(QObject* parent = nullptr);
  ~SimulationController() override;

  /// A new scene with its pictures; `content.leafCount` is set by the controller. `state` as of sim::Engine::save;
  /// `keepMotion` goes on where the scene before was, if it fits. A null content keeps the one that is there.
  void setScene(sim::SceneDescription scene, std::shared_ptr<render::SceneContent> content,
                const QByteArray& state = {}, bool keepMotion = false, std::vector<int> keep = {});
  /// No scene: an empty ground.
  void clear();
  bool hasScene() const { return hasScene_; }

  void setWind(const sim::WindSettings& wind);
  void setLeaves(const sim::LeafSettings& leaves);
  void setTree(std::size_t instance, std::shared_ptr<const sim::Tree> tree);
  /// A hand on a branch while it runs; nothing: lets go.
  void setPull(const std::optional<sim::Pull>& pull);
  /// Shows a recorded motion instead of the simulation, from its start; null: the simulation again.
  void setClip(std::shared_ptr<const ClipPlay> clip);
  bool playsClip() const { return clip_ != nullptr; }
  double clipTime() const { return clipTime_; }
  /// Threads of air in the picture.
  void setStreaks(bool on);
  /// The scene goes on on another device.
  void setDevice(sim::Device device);
  sim::Device wantedDevice() const { return device_; }

  void play();
  void pause();
  void step();
  void reset();
  bool isPlaying() const { return playing_; }
  /// What the last frame reported.
  const FrameResult& last() const { return last_; }
  /// s of real time dropped since play began.
  double lostTime() const { return lostTime_; }

  /// Calls back on the GUI thread with the matrix of every link as it stands in the next picture.
  void requestPose(std::function<void(const std::vector<mat4>&)> callback);
  /// Every frame brings its pose along (FrameResult::pose).
  void setPoseWatched(bool watched);
  /// The state now; waits until the frame in work is done. Nothing while there is no engine for the scene yet.
  struct State {
    double time = 0;   ///< s
    QByteArray bytes;  ///< empty at the start
  };
  std::optional<State> saveState();

  void setView(vec3 toSun, float sunStrength);
  /// px that adaptive wood may be off, and px of a leaf below which cards stand for clusters (0: never).
  void setDetail(float tolerance, float cardsBelow);
  void setHighlighted(std::vector<std::uint32_t> links);
  /// Colours instead of bark (render::View::linkColors); empty: bark.
  void setLinkColors(std::vector<std::uint32_t> colors);

  /// Nothing is in work and the newest frame is in the renderer's hands.
  bool isSettled() const;

  void prepare(render::Renderer& renderer) override;
  void describe(render::View& view) const override;
  void release() override;

 signals:
  /// The picture is out of date: draw.
  void redrawWanted();
  /// A frame was computed; see last().
  void reported();
  void playingChanged(bool playing);
  /// The simulation stands still, at `time` seconds; `bytes` are empty at the start.
  void stopped(double time, const QByteArray& bytes);
  void problem(const QString& text);

 private:
  void post(FrameTask task);
  void finish(FrameResult result);
  void pump();
  FrameTask takePending();
  bool wantsFrame() const;

  QThread thread_;
  std::unique_ptr<QObject> onThread_;  ///< lives on thread_: what is called through it runs there
  std::unique_ptr<SimulationWorker> worker_;

  bool hasScene_ = false, playing_ = false, inFlight_ = false;
  sim::Device device_ = sim::Device::Auto;
  FrameTask pending_;
  sim::SceneDescription scene_;  ///< as it is now, for another device
  std::shared_ptr<render::SceneContent> content_;
  bool contentOutdated_ = false;  ///< the renderer does not have content_
  bool frameOutdated_ = false;    ///< the newest picture lacks something
  int generation_ = 0;            ///< of the renderer's slots; older ones are gone
  int flightGeneration_ = 0;
  int sceneNumber_ = 0, flightScene_ = 0;  ///< what an older scene reports late is not this one's state
  std::optional<render::FrameSlot> ready_;
  FrameResult last_;
  QElapsedTimer clock_;
  double lostTime_ = 0;
  bool poseWatched_ = false;
  std::vector<std::function<void(const std::vector<mat4>&)>> poseCallbacks_;
  QString shownProblem_;
  vec3 toSun_{0.5f, 0.6f, 0.6f};
  float tolerance_ = 0.5f, cardsBelow_ = 1.5f;
  float sunStrength_ = 1;
  std::vector<std::uint32_t> highlighted_, linkColors_;
  std::shared_ptr<const ClipPlay> clip_;
  double clipTime_ = 0;  ///< s
  bool streaks_ = false;
};

}  // namespace windfall::widgets
