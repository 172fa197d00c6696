// The example beside the target: whose region lends its colours to which, by equal colours, changeable by hand.
#pragma once

#include <QWidget>
#include <map>
#include <memory>
#include <optional>

#include "model/document/document.h"
#include "model/document/job.h"
#include "model/leaf/stages.h"
#include "widgets/leaf/image_pane.h"

class QLabel;
class QListWidget;
class QListWidgetItem;

namespace windfall::widgets {

class LeafPictures;

/// Shown while regions are matched: the leaves that may lend their colours, ticked those that do; a pane with the photo
/// and regions of one of them, and the target's regions in the colours of their partners, paler where another leaf
/// lends. A click on a region here pairs it with the one chosen there.
class RegionMatchView : public QWidget {
  Q_OBJECT
 public:
  RegionMatchView(model::Document& document, model::JobRunner& jobs, LeafPictures& pictures, QWidget* parent = nullptr);

  /// Computes and shows the match, or stops doing so.
  void setActive(bool active);
  bool isActive() const { return active_; }
  bool isComputing() const { return running_ != 0; }
  /// The region of the target that the next click pairs.
  void choose(std::optional<QPointF> target);
  /// The target's regions in the colours of the match; null until it is computed.
  const MipImage& targetPicture() const { return targetPicture_; }
  /// Region i + 1 of the target takes colours of region match()[i] of the examples, which count on from leaf to leaf.
  const std::vector<int>& match() const { return match_; }
  ImagePane& pane() { return *pane_; }
  QListWidget* exampleList() const { return list_; }
  /// The leaf that is shown here.
  model::AssetId example() const;

 signals:
  void pictureChanged();

 private:
  /// The leaves that lend: the examples, or the target itself.
  std::vector<model::AssetId> lenders() const;
  void setLenders(std::vector<model::AssetId> lenders);
  void whenChanged(const model::Change& change);
  void listLeaves();
  void whenTicked(QListWidgetItem* item);
  void show(int row);
  void compute();
  void pairWith(QPointF source);

  using Known = std::map<model::AssetId, std::shared_ptr<const model::LeafStages>>;

  model::Document& document_;
  model::JobRunner& jobs_;
  LeafPictures& pictures_;
  ImagePane* pane_;
  QListWidget* list_;
  QLabel* hint_;
  Known known_;  ///< stages of the leaves that lend and of the one shown
  model::AssetId shown_;
  MipImage targetPicture_;
  std::vector<int> match_;
  std::optional<QPointF> target_;
  bool active_ = false;
  quint64 running_ = 0, lastRun_ = 0;
};

}  // namespace windfall::widgets
