// One plant alone: its branches in a list and in the view, and what can be tuned about them.
#pragma once

#include <QPointer>
#include <QTimer>

#include "widgets/plant/branch_panel.h"
#include "widgets/scene/scene_feed.h"
#include "widgets/scene/simulation_controller.h"
#include "widgets/viewport/viewport.h"
#include "widgets/workspace.h"

namespace windfall::widgets {

class BranchAttributes;
class MotionPlot;
class PlantSettings;
class PlantShaping;
class Transport;

class PlantWorkspace : public Workspace {
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

   private:
    PlantWorkspace& workspace_;
  };

  std::optional<model::Project> alone() const;
  model::LoadedPlant loaded() const;
  void makeInspector();
  void makeStrip();
  void follow(const model::Change& change);
  void choosePlant(model::AssetId plant);
  void showPlant();
  void showChosen();
  void showFrame();
  void setWind(double speed);
  void askForFile();
  void grow();
  void fillNewMenu(QMenu& menu);
  void addPlant(model::Plant plant, bool withLeaves = true);
  std::optional<Box> bounds(bool chosenOnly) const;

  WorkspaceContext context_;
  model::AssetId plant_;
  SimulationController controller_;
  SceneFeed feed_;
  ClickTool click_{*this};
  QPointer<Viewport> viewport_;  ///< may go before the workspace, with its window
  QWidget *inspector_, *strip_;
  BranchPanel* branches_ = nullptr;
  BranchAttributes* attributes_ = nullptr;
  PlantSettings* settings_ = nullptr;
  PlantShaping* shaping_ = nullptr;
  Transport* transport_ = nullptr;
  MotionPlot* motion_ = nullptr;
  QAction *select_ = nullptr, *chooseAll_ = nullptr, *chooseNone_ = nullptr;
  std::vector<std::size_t> chosen_;  ///< links
  std::optional<std::size_t> tipLink_;
  model::AssetId framedPlant_;
  QTimer regrow_;  ///< a pause in dragging before the plant grows anew
  bool active_ = false, outdated_ = true, keepCamera_ = false;
};

}  // namespace windfall::widgets
