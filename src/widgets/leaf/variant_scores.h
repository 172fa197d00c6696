// Scores of a leaf's variants, found in the background.
#pragma once

#include <QObject>
#include <map>
#include <optional>

#include "model/document/document.h"
#include "model/document/job.h"
#include "model/leaf/variant_score.h"

namespace windfall::widgets {

/// Knows the scores of pictures by their cache keys: what was scored once stays so through undo and redo. They are no
/// part of the document.
class VariantScores : public QObject {
  Q_OBJECT
 public:
  VariantScores(model::Document& document, model::JobRunner& jobs, QObject* parent = nullptr);

  /// Empty until it was found.
  std::optional<model::VariantScore> of(const model::Variant& variant) const;
  /// Starts a job if a variant of this leaf has none yet; one of another leaf becomes stale.
  void want(model::AssetId leaf);

 signals:
  void changed();

 private:
  model::Document& document_;
  model::JobRunner& jobs_;
  std::map<qint64, model::VariantScore> known_;
};

}  // namespace windfall::widgets
