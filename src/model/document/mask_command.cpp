#include "model/document/mask_command.h"

#include <algorithm>
#include <cstring>

#include "model/document/change.h"
#include "model/document/project.h"

namespace windfall::model {

namespace {

constexpr int kTile = 64;

bool differ(const QImage& a, const QImage& b, const QRect& area) {
  for (int y = area.top(); y <= area.bottom(); ++y) {
    const size_t length = static_cast<size_t>(area.width());
    if (std::memcmp(a.constScanLine(y) + area.left(), b.constScanLine(y) + area.left(), length) != 0) return true;
  }
  return false;
}

void swapPixels(QImage& image, QImage& tile, QPoint corner) {
  for (int y = 0; y < tile.height(); ++y) {
    uchar* row = tile.scanLine(y);
    std::swap_ranges(row, row + tile.width(), image.scanLine(corner.y() + y) + corner.x());
  }
}

}  // namespace

PaintMask::PaintMask(Document& document, AssetId leaf, const QImage& after, QRect dirty, const QString& text)
    : DocumentCommand(document, text), leaf_(leaf) {
  const QImage& before = project().leaf(leaf)->mask;
  if (before.size() != after.size() || before.format() != QImage::Format_Grayscale8) {
    whole_ = true;
    image_ = after;
    return;
  }
  const QRect area = dirty.isEmpty() ? after.rect() : dirty.intersected(after.rect());
  if (area.isEmpty()) return;
  for (int top = area.top() / kTile * kTile; top <= area.bottom(); top += kTile) {
    for (int left = area.left() / kTile * kTile; left <= area.right(); left += kTile) {
      const QRect tile = QRect(left, top, kTile, kTile).intersected(after.rect());
      if (!differ(before, after, tile)) continue;
      tiles_.push_back({tile.topLeft(), after.copy(tile)});
      dirty_ |= tile;
    }
  }
}

qsizetype PaintMask::bytes() const {
  qsizetype sum = image_.sizeInBytes();
  for (const Tile& tile : tiles_) sum += tile.pixels.sizeInBytes();
  return sum;
}

void PaintMask::swap() {
  Leaf* leaf = project().leaf(leaf_);
  if (!leaf) return;
  if (whole_) {
    leaf->mask.swap(image_);
  } else {
    for (Tile& tile : tiles_) swapPixels(leaf->mask, tile.pixels, tile.corner);
  }
  announce({leaf_, Aspect::LeafMask, dirty_});
}

}  // namespace windfall::model
