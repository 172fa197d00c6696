// The example beside the target: whose region lends its colours to which, by equal colours, changeable by hand.
#pragma once

#include <QWidget>
#include <memory>
#include <optional>

#include "model/document/document.h"
#include "model/document/job.h"
#include "model/leaf/stages.h"
#include "widgets/leaf/image_pane.h"

class QLabel;

namespace windfall::widgets {

class ComboBox;
class LeafPictures;

/// Shown while regions are matched: a pane with the example's photo and regions, a choice of which leaf that is, and
/// the target's regions in the colours of their partners. A click on a region here pairs it with the one chosen there.
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
  /// Region i + 1 of the target takes colours of region match()[i] of the example.
  const std::vector<int>& match() const { return match_; }
  ImagePane& pane() { return *pane_; }
  ComboBox* exampleBox() const { return examples_; }
  model::AssetId example() const;

 signals:
  void pictureChanged();

 private:
  void whenChanged(const model::Change& change);
  void listLeaves();
  void setExample(int index);
  void compute();
  void pairWith(QPointF source);

  model::Document& document_;
  model::JobRunner& jobs_;
  LeafPictures& pictures_;
  ImagePane* pane_;
  ComboBox* examples_;
  QLabel* hint_;
  std::shared_ptr<const model::LeafStages> stages_;  ///< of the example
  MipImage targetPicture_;
  std::vector<int> match_;
  std::optional<QPointF> target_;
  bool active_ = false;
  quint64 running_ = 0, lastRun_ = 0;
};

}  // namespace windfall::widgets
