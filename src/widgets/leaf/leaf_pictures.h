// The stages of the shown leaf and their pictures, computed in the background as far as they are looked at.
#pragma once

#include <QObject>
#include <memory>

#include "model/document/document.h"
#include "model/document/job.h"
#include "model/leaf/stages.h"
#include "widgets/leaf/mip_image.h"

namespace windfall::widgets {

/// How a stage came to be, for the dot beside its name.
enum class StageState { Unknown, Automatic, Edited, OutOfDate };

/// What one run of the background work gives.
struct StageResult {
  model::LeafStages stages;
  MipImage photo;    ///< null when it was known already
  MipImage picture;  ///< of the stage asked for; null for the photo
  model::Stage stage = model::Stage::Photo;
};

/// Follows the document: an edit makes what depends on it out of date, and it is computed anew when it is wanted. Old
/// pictures stay until the new ones are there; results of an older state are dropped.
class LeafPictures : public QObject {
  Q_OBJECT
 public:
  LeafPictures(model::Document& document, model::JobRunner& jobs, QObject* parent = nullptr);

  void setLeaf(model::AssetId leaf);
  model::AssetId leafId() const { return id_; }
  const model::Leaf* leaf() const { return document_.project().leaf(id_); }
  /// Shows this stage from now on: computes it if it is out of date.
  void want(model::Stage stage);
  model::Stage wanted() const { return wanted_; }

  StageState state(model::Stage stage) const;
  bool isUpToDate(model::Stage stage) const { return known_ && stage <= valid_; }
  /// What is known, perhaps out of date; null before the first result.
  const model::LeafStages* stages() const { return known_ ? &stages_ : nullptr; }
  const MipImage& photo() const { return photo_; }
  /// Of the wanted stage, or the one before it until it is there; null for Photo and Variants.
  const MipImage& picture() const { return picture_; }
  /// The artist's mask, or the automatic one; null until it is known.
  QImage mask() const;
  bool isComputing() const { return running_ != 0; }

  /// Dims what is not leaf: premultiplied, `part` of the mask.
  static QImage maskTint(const QImage& mask, QRect part);

 signals:
  void photoChanged();
  void pictureChanged();
  /// A part of the mask's tint (photo pixels).
  void maskPartChanged(QRect part);
  void statesChanged();

 private:
  void whenChanged(const model::Change& change);
  void invalidate(model::Stage from);
  void invalidateParameters();
  void compute();
  void take(StageResult result, quint64 generation);
  void showMask(QRect part);

  model::Document& document_;
  model::JobRunner& jobs_;
  model::AssetId id_;
  model::Stage wanted_ = model::Stage::Photo;
  model::Stage valid_ = model::Stage::Photo;  ///< the last stage that is up to date, if known_
  model::LeafStages stages_;
  model::LeafParameters parameters_;  ///< as of the last look
  QImage automaticMask_;
  MipImage photo_, picture_;
  bool known_ = false;
  quint64 generation_ = 0;             ///< counts edits: results of an older one are dropped
  quint64 running_ = 0, lastRun_ = 0;  ///< job under way, 0: none
};

}  // namespace windfall::widgets
