// The slow work of the leaf workspace: opening photos, making variants, writing atlases.
#pragma once

#include <QObject>
#include <functional>

#include "model/document/document.h"
#include "model/document/job.h"
#include "model/leaf/stages.h"

namespace windfall::widgets {

/// Endings of the pictures that can be opened: "jpg".
QStringList photoEndings();

class LeafJobs : public QObject {
  Q_OBJECT
 public:
  LeafJobs(model::Document& document, model::JobRunner& jobs, QObject* parent = nullptr);

  /// Reads and decodes the photo; a new leaf when `replace` is 0, else that leaf's photo (its marks are kept).
  void openPhoto(const QString& path, model::AssetId replace = {});
  /// Appends `count` new textures, with seeds after the largest there is. `known`: stages up to the superpixels if they
  /// are up to date, else null.
  void makeVariants(model::AssetId leaf, int count, const model::LeafStages* known);
  /// Reads a picture of lines in the photo's size; they become the leaf's own veins.
  void loadVeins(const QString& path, model::AssetId leaf);
  /// Makes an asset of each leaf in the photo; `mask` is one of them. One undo step.
  void splitLeaves(model::AssetId leaf, const QImage& mask);
  /// Says so where the photo of a new leaf shows several.
  void offerSplit(model::AssetId leaf);
  /// Packs the kept variants of all leaves into `path` and its description beside it.
  void exportAtlas(const QString& path);

 signals:
  void photoOpened(windfall::model::AssetId leaf);
  void variantsChanged(bool running);
  void message(const QString& text, bool isError);

 private:
  model::Document& document_;
  model::JobRunner& jobs_;
};

}  // namespace windfall::widgets
