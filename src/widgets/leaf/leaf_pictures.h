// The stages of the shown leaf and their pictures, computed in the background as far as they are looked at.
#pragma once

#include <QObject>
#include <QTimer>
#include <memory>

#include "model/document/document.h"
#include "model/document/job.h"
#include "model/leaf/field_picture.h"
#include "model/leaf/stages.h"
#include "widgets/leaf/mip_image.h"

namespace windfall::widgets {

/// How a stage came to be, for the dot beside its name.
enum class StageState { Unknown, Automatic, Edited, OutOfDate };

/// What one run of the background work gives.
struct StageResult {
  std::shared_ptr<const model::LeafStages> stages;
  MipImage photo;                            ///< null when it was known already
  MipImage picture;                          ///< of the stage asked for; null for the photo
  model::FieldScale scale;                   ///< of the field, at Stage::Distance
  model::Stage stage = model::Stage::Photo;  ///< how far it was computed
  model::Stage shown = model::Stage::Photo;  ///< whose picture it is
  model::LeafField field = model::LeafField::Structural;
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

  /// Which field Stage::Distance shows.
  void setField(model::LeafField field);
  model::LeafField field() const { return field_; }
  const model::FieldScale& scale() const { return scale_; }

  StageState state(model::Stage stage) const;
  bool isUpToDate(model::Stage stage) const { return known_ && stage <= valid_; }
  /// What is known, perhaps out of date; null before the first result.
  const model::LeafStages* stages() const { return known_ ? stages_.get() : nullptr; }
  /// The last result that went farthest, for a computation that goes on from it; null: none.
  std::shared_ptr<const model::LeafStages> deepestStages() const { return known_ ? deepest_ : nullptr; }
  const MipImage& photo() const { return photo_; }
  /// Of the wanted stage, or the one before it until it is there; null for Photo and Variants.
  const MipImage& picture() const { return picture_; }
  /// The artist's mask, or the automatic one; null until it is known.
  QImage mask() const;
  bool isComputing() const { return running_ != 0 || waiting_.isActive(); }

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
  /// Soon, and once for many edits in a row.
  void schedule();
  void compute();
  model::Stage goal() const;
  void take(StageResult result, quint64 generation);
  void showMask(QRect part);

  model::Document& document_;
  model::JobRunner& jobs_;
  model::AssetId id_;
  model::Stage wanted_ = model::Stage::Photo;
  model::Stage valid_ = model::Stage::Photo;  ///< the last stage that is up to date, if known_
  std::shared_ptr<const model::LeafStages> stages_ = std::make_shared<model::LeafStages>();
  /// The last result that went farthest: what it found later than the present ones reach is looked at again.
  std::shared_ptr<const model::LeafStages> deepest_;
  model::LeafField field_ = model::LeafField::Structural;
  model::FieldScale scale_;
  QTimer waiting_;
  model::LeafParameters parameters_;  ///< as of the last look
  QImage automaticMask_;
  MipImage photo_, picture_;
  bool known_ = false;
  quint64 generation_ = 0;             ///< counts edits: results of an older one are dropped
  quint64 running_ = 0, lastRun_ = 0;  ///< job under way, 0: none
};

}  // namespace windfall::widgets
