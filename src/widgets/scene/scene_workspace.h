// The scene: trees in the wind, leaves that fall.
#pragma once

#include <QPointer>

#include "widgets/scene/fan_tool.h"
#include "widgets/scene/scene_feed.h"
#include "widgets/scene/scene_selection.h"
#include "widgets/scene/scene_tools.h"
#include "widgets/scene/simulation_controller.h"
#include "widgets/viewport/viewport.h"
#include "widgets/workspace.h"

class QActionGroup;

namespace windfall::widgets {

class HistoryPlot;
class LeafCounts;
class SceneInspector;
class Transport;

class SceneWorkspace : public Workspace, private SceneToolHost {
  Q_OBJECT
 public:
  explicit SceneWorkspace(const WorkspaceContext& context, QObject* parent = nullptr);
  ~SceneWorkspace() override;

  QString id() const override { return QStringLiteral("scene"); }
  QString title() const override { return tr("Scene"); }
  QWidget* canvas() override;
  QWidget* inspector() override;
  QWidget* strip() override;
  QList<QAction*> tools() override;
  void fillMenu(QMenu& menu) override;
  void add() override { addTree(); }
  QWidget* corner() override { return device_; }
  void activate() override;
  void deactivate() override;
  void show(model::AssetId asset) override;
  bool isSettled() const override;
  void beforeSave() override;
  bool openFile(const QString& path) override;
  QJsonObject saveView() const override;
  void restoreView(const QJsonObject& view) override;

  SimulationController& controller() { return controller_; }
  SceneFeed& feed() { return feed_; }
  SceneSelection& selection() override { return selection_; }
  Viewport& viewport() { return *viewport_; }

 private:
  model::Document& document() override { return context_.document; }
  model::AssetId treeAt(const Ray& ray, float slack, vec3* place) override;
  void makeTools();
  void makeStrip();
  void follow(const model::Change& change);
  void showFrame();
  void showHint();
  void keepCamera();
  void addTree();
  void duplicateTrees();
  void deleteTrees();
  void frameAll();
  void loadRecord(const QString& path);
  void askForRecord();
  void setStreaks(bool on);
  std::optional<Box> boundsOfTrees(bool chosenOnly) const;
  QAction* addTool(ViewportTool& tool, const QString& iconName, const QString& text, const QString& help,
                   const QKeySequence& shortcut);

  WorkspaceContext context_;
  SimulationController controller_;
  SceneSelection selection_;
  SceneFeed feed_;
  SelectTreesTool select_{*this};
  MoveTreesTool move_{*this};
  TurnTreesTool turn_{*this};
  FanTool fan_{*this};
  QPointer<Viewport> viewport_;  ///< may go before the workspace, with its window
  SceneInspector* inspector_;
  QWidget *strip_, *device_;
  Transport* transport_ = nullptr;
  HistoryPlot* timers_ = nullptr;
  LeafCounts* counts_ = nullptr;
  QActionGroup* toolGroup_ = nullptr;
  QAction *streaks_ = nullptr, *fanAction_ = nullptr;
  QAction *duplicate_ = nullptr, *delete_ = nullptr, *selectAll_ = nullptr;
  bool framed_ = false, keepingCamera_ = false;
};

}  // namespace windfall::widgets
