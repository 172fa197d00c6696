// One plant alone: its branches in a list and in the view, and what can be tuned about them.
#pragma once

#include <QFileSystemWatcher>
#include <QPointer>
#include <QTimer>
#include <map>
#include <set>

#include "widgets/plant/box_tool.h"
#include "widgets/plant/branch_panel.h"
#include "widgets/plant/pull_tool.h"
#include "widgets/scene/scene_feed.h"
#include "widgets/scene/simulation_controller.h"
#include "widgets/viewport/viewport.h"
#include "widgets/workspace.h"

namespace windfall::widgets {

class BranchAttributes;
class ClipPanel;
class MotionPlot;
class PlantSettings;
class SurfacePanel;
class PlantShaping;
class Transport;

class PlantWorkspace : public Workspace, private PullHost {
  Q_OBJECT
 public:
  explicit PlantWorkspace(const WorkspaceContext& context, QObject* parent = nullptr);
  ~PlantWorkspace() override;

  QString id() const override { return QStringLiteral("plant"); }
  QString title() const override { return tr("Plant"); }
  QWidget* canvas() override { return viewport_; }
  QWidget* inspector() override { return inspector_; }
  QWidget* strip() override { return strip_; }
  QList<QAction*> tools() override;
  void fillMenu(QMenu& menu) override;
  bool openFile(const QString& path) override;
  void add() override;
  void exportResult(bool elsewhere) override;
  void activate() override;
  void deactivate() override;
  void show(model::AssetId asset) override;
  QJsonObject saveView() const override;
  void restoreView(const QJsonObject& view) override;
  bool isSettled() const override;

  model::AssetId plant() const { return plant_; }
  SimulationController& controller() { return controller_; }
  SceneFeed& feed() { return feed_; }
  BranchPanel& branches() { return *branches_; }
  MotionPlot& motion() { return *motion_; }
  SurfacePanel& surface() { return *surface_; }
  Viewport& viewport() { return *viewport_; }
  PlantShaping& shaping() { return *shaping_; }
  /// Adds a full-grown plant of a preset, with its species' own leaves.
  void growPreset(const QString& name);

 private:
  /// Clicks on branches; everything else is left to the camera.
  class ClickTool : public ViewportTool {
   public:
    explicit ClickTool(PlantWorkspace& workspace) : workspace_(workspace) {}
    void click(const ViewportEvent& event) override;
    void paint(QPainter& painter, const OrbitCamera& camera, QSize size) const override {
      workspace_.paintPins(painter, camera, size);
    }

   private:
    PlantWorkspace& workspace_;
  };
  /// The other tools, with the pins over the picture.
  template <class Tool>
  class WithPins : public Tool {
   public:
    template <class... Arguments>
    explicit WithPins(PlantWorkspace& workspace, Arguments&&... arguments)
        : Tool(std::forward<Arguments>(arguments)...), workspace_(workspace) {}
    void paint(QPainter& painter, const OrbitCamera& camera, QSize size) const override {
      workspace_.paintPins(painter, camera, size);
      Tool::paint(painter, camera, size);
    }

   private:
    PlantWorkspace& workspace_;
  };

  const std::vector<LinkCapsule>& pullCapsules() const override { return feed_.capsules(); }
  const std::vector<mat4>& pullPose() const override { return controller_.last().pose; }
  void pull(const std::optional<sim::Pull>& pull) override;
  void paintPins(QPainter& painter, const OrbitCamera& camera, QSize size) const;
  void makeTools();
  void makeChoices();
  void choose(const std::function<std::vector<std::size_t>(const sim::Tree&, const std::vector<std::size_t>&)>& wanted);
  const sim::Tree* tree() const;
  void showClip();
  void tellAboutPlant();

  std::optional<model::Project> alone() const;
  model::LoadedPlant loaded() const;
  void makeInspector();
  void makeStrip();
  void follow(const model::Change& change);
  void choosePlant(model::AssetId plant);
  void showPlant();
  void showChosen();
  void showFrame();
  void showSettings();
  void exportTo(const QString& path);
  void showData();
  void askForReplacement();
  /// Replaces the shown plant's file and keeps what is set about it.
  void replaceFile(const QString& path);
  void watchFile(model::AssetId plant, const QString& path);
  void fileChanged(const QString& path);
  void setWind(double speed);
  void askForFile();
  void grow();
  void fillNewMenu(QMenu& menu);
  void addPlant(model::Plant plant, const QString& path = {}, bool withLeaves = true);
  std::optional<Box> bounds(bool chosenOnly) const;

  WorkspaceContext context_;
  model::AssetId plant_;
  SimulationController controller_;
  SceneFeed feed_;
  ClickTool click_{*this};
  WithPins<BoxTool> boxTool_;
  WithPins<PullTool> pullTool_{*this, static_cast<PullHost&>(*this)};
  QPointer<Viewport> viewport_;  ///< may go before the workspace, with its window
  QWidget *inspector_, *strip_;
  BranchPanel* branches_ = nullptr;
  BranchAttributes* attributes_ = nullptr;
  PlantSettings* settings_ = nullptr;
  SurfacePanel* surface_ = nullptr;
  QFileSystemWatcher watcher_;
  std::map<model::AssetId, QString> paths_;  ///< where a plant's file was read from, in this session
  std::set<model::AssetId> changedOnDisk_;
  std::map<model::AssetId, QString> exports_;  ///< where each plant went last
  QJsonObject exportValues_;
  PlantShaping* shaping_ = nullptr;
  ClipPanel* clips_ = nullptr;
  Transport* transport_ = nullptr;
  MotionPlot* motion_ = nullptr;
  QAction *box_ = nullptr, *pull_ = nullptr, *pin_ = nullptr, *copy_ = nullptr, *paste_ = nullptr;
  std::vector<QAction*> choices_;  ///< what chooses by chain, order, children
  model::AssetId toldPlant_;
  QAction *select_ = nullptr, *chooseAll_ = nullptr, *chooseNone_ = nullptr;
  std::vector<std::size_t> chosen_;  ///< links
  std::optional<std::size_t> tipLink_;
  model::AssetId framedPlant_;
  QTimer regrow_;  ///< a pause in dragging before the plant grows anew
  bool active_ = false, outdated_ = true, keepCamera_ = false;
};

}  // namespace windfall::widgets
