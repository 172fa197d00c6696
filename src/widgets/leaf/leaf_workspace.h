// Leaf workspace: from the photo to new textures.
#pragma once

#include "model/leaf/stages.h"
#include "widgets/workspace.h"

class QStackedWidget;

namespace windfall::widgets {

class AtlasPanel;
class ImagePane;
class MapsView;
class LeafInspector;
class LeafJobs;
class LeafPictures;
class LeafToolBox;
class RegionMatchView;
class StageBar;
class ToolOptions;
class VariantStrip;

class LeafWorkspace : public Workspace {
  Q_OBJECT
 public:
  LeafWorkspace(WorkspaceContext context, QWidget* window);
  ~LeafWorkspace() override;

  QString id() const override { return QStringLiteral("leaf"); }
  QString title() const override { return tr("Leaf"); }
  QWidget* canvas() override { return canvas_; }
  QWidget* inspector() override;
  QWidget* strip() override;
  QList<QAction*> tools() override;
  void fillMenu(QMenu& menu) override;
  void deactivate() override;
  void show(model::AssetId leaf) override;
  QJsonObject saveView() const override;
  void restoreView(const QJsonObject& view) override;
  bool isSettled() const override;
  bool openFile(const QString& path) override;
  void add() override;
  void exportResult(bool elsewhere) override;

  model::AssetId leaf() const;
  void setStage(model::Stage stage);
  ImagePane& pane() { return *pane_; }
  StageBar& stageBar() { return *stageBar_; }
  LeafPictures& pictures() { return *pictures_; }
  LeafToolBox& toolBox() { return *toolBox_; }
  VariantStrip& variants() { return *strip_; }
  RegionMatchView& regionMatch() { return *match_; }
  AtlasPanel& atlas() { return *atlas_; }
  ToolOptions& toolOptions() { return *toolOptions_; }
  LeafInspector& numbers() { return *inspector_; }

 private:
  void buildCanvas(QWidget* window);
  QString askForPhoto(const QString& title);
  void updateStates();
  void updatePicture();
  /// Says once what is wrong with markers by hand.
  void tellOfMarkers();
  void updateStatus();
  void makeVariants(int count);
  void addMaskActions(QMenu& menu);
  void addVeinActions(QMenu& menu);
  void loadVeins();
  template <class T>
  void resetMark(T model::Leaf::*mark, model::Aspect aspect, const QString& text);

  WorkspaceContext context_;
  LeafPictures* pictures_;
  LeafJobs* jobs_;
  MapsView* maps_;
  AtlasPanel* atlas_ = nullptr;
  model::Stage stage_ = model::Stage::Photo;
  QWidget* window_;
  QWidget* canvas_;
  QStackedWidget* stack_;
  StageBar* stageBar_;
  ToolOptions* toolOptions_;
  std::vector<QPointF> toldOf_;  ///< the markers that were last looked at
  ImagePane* pane_;
  LeafToolBox* toolBox_;
  RegionMatchView* match_;
  LeafInspector* inspector_;
  VariantStrip* strip_;
  QPointF pointer_;
  bool variantsShown_ = false;
};

}  // namespace windfall::widgets
