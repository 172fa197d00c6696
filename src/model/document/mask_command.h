// A brush stroke on a leaf's mask as an undo step.
#pragma once

#include <QImage>
#include <QRect>
#include <vector>

#include "model/document/command.h"

namespace windfall::model {

struct Leaf;

/// Keeps the 64 px tiles that the stroke changed and swaps them with the mask's own on undo and redo; where the mask
/// was automatic, or its size changes, the whole picture.
class PaintMask : public DocumentCommand {
 public:
  /// `after` has the format Grayscale8.
  PaintMask(Document& document, AssetId leaf, const QImage& after, QRect dirty, const QString& text);

  /// True where the stroke changed nothing.
  bool isEmpty() const { return !whole_ && tiles_.empty(); }
  /// Memory of the tiles, in bytes.
  qsizetype bytes() const;

  void redo() override { swap(); }
  void undo() override { swap(); }

 private:
  struct Tile {
    QPoint corner;
    QImage pixels;
  };
  void swap();

  AssetId leaf_;
  std::vector<Tile> tiles_;
  QRect dirty_;         ///< of the changed tiles
  bool whole_ = false;  ///< swap `image_` instead of tiles
  QImage image_;
};

}  // namespace windfall::model
