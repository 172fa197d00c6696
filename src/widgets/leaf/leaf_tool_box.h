// The tools of the leaf workspace at work: actions to choose them, the pane's events to the chosen one.
#pragma once

#include <QAction>
#include <QObject>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "model/document/job.h"
#include "widgets/leaf/image_pane.h"
#include "widgets/leaf/leaf_pictures.h"
#include "widgets/tools/tool.h"

namespace windfall::widgets {

class LeafToolBox : public QObject, private ToolHost {
  Q_OBJECT
 public:
  LeafToolBox(model::Document& document, model::JobRunner& jobs, LeafPictures& pictures, ImagePane& pane,
              QObject* parent = nullptr);
  ~LeafToolBox() override;

  QList<QAction*> actions() const { return actions_; }
  Tool& current() const { return *tools_[current_]; }
  Tool* tool(const QString& id) const;
  void choose(const QString& id);
  /// Ends a stroke without a trace.
  void cancel();
  /// [ and ]: a tenth larger or smaller, one pixel at least.
  void resizeTool(int direction);
  void setToolSize(double size);
  /// What the current tool lets be set, and setting it.
  std::vector<ToolOption> options() { return current().options(*this); }
  void setOption(const QString& id, double value, const QString& gesture);
  /// Another mask, computed in the background from the shown one, as one undo step.
  void editMask(const QString& text, std::function<QImage(const QImage&)> edit);

 signals:
  /// The region tool waits for a click in the example, or no longer.
  void regionChosen(std::optional<QPointF> target);
  void toolChanged();
  /// The tool drew something, or was told a value: its options may have changed.
  void toolUpdated();
  /// The tool works on this stage: it should be seen.
  void stageNeeded(windfall::model::Stage stage);

 private:
  void chooseIndex(std::size_t index);

  model::Document& document() override { return document_; }
  model::AssetId leaf() const override { return pictures_.leafId(); }
  QImage currentMask() const override { return pictures_.mask(); }
  std::optional<QPointF> currentRoot() const override;
  std::vector<QPointF> currentMarkers() const override;
  std::vector<QPointF> currentTips() const override;
  model::Veins currentVeins() const override;
  const model::LeafStages* stages() const override { return pictures_.stages(); }
  void computeMask(const QString& text, const std::function<Result<QImage>(model::Progress&)>& work) override;
  void chooseRegion(std::optional<QPointF> target) override { emit regionChosen(target); }
  void previewMask(const QImage& mask, QRect dirty) override;
  double pixelSize() const override { return 1 / pane_.zoom(); }
  void requestUpdate() override {
    pane_.update();
    emit toolUpdated();
  }

  model::Document& document_;
  model::JobRunner& jobs_;
  LeafPictures& pictures_;
  ImagePane& pane_;
  std::vector<std::unique_ptr<Tool>> tools_;
  QList<QAction*> actions_;
  std::size_t current_ = 0;
};

}  // namespace windfall::widgets
