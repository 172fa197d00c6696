#include "widgets/leaf/mip_image.h"

#include <QPainter>

namespace windfall::widgets {

namespace {
constexpr int kSmallest = 64;  // px of the longer side of the last level

/// Many photos have an alpha channel and nothing in it.
bool isOpaque(const QImage& image) {
  for (int y = 0; y < image.height(); ++y) {
    const auto* row = reinterpret_cast<const QRgb*>(image.constScanLine(y));
    if (std::any_of(row, row + image.width(), [](QRgb pixel) { return qAlpha(pixel) < 255; })) return false;
  }
  return true;
}

}  // namespace

MipImage::MipImage(const QImage& image) {
  if (image.isNull()) return;
  levels_.push_back(image.convertToFormat(QImage::Format_ARGB32_Premultiplied));
  alpha_ = image.hasAlphaChannel() && !isOpaque(levels_.front());
  while (std::max(levels_.back().width(), levels_.back().height()) > kSmallest) {
    const QSize half((levels_.back().width() + 1) / 2, (levels_.back().height() + 1) / 2);
    levels_.emplace_back(half, QImage::Format_ARGB32_Premultiplied);
    halve(levels_.size() - 1, levels_.back().rect());
  }
}

void MipImage::replace(const QImage& part, QPoint at) {
  if (isNull()) return;
  QRect area = QRect(at, part.size()) & levels_.front().rect();
  if (area.isEmpty()) return;
  {
    QPainter painter(&levels_.front());
    painter.setCompositionMode(QPainter::CompositionMode_Source);
    painter.drawImage(at, part);
  }
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    area = QRect(QPoint(area.left() / 2, area.top() / 2), QPoint(area.right() / 2, area.bottom() / 2));
    halve(level, area & levels_[level].rect());
  }
}

void MipImage::halve(std::size_t level, QRect part) {
  const QImage& from = levels_[level - 1];
  QImage& to = levels_[level];
  for (int y = part.top(); y <= part.bottom(); ++y) {
    const auto* above = reinterpret_cast<const QRgb*>(from.constScanLine(2 * y));
    const auto* below = reinterpret_cast<const QRgb*>(from.constScanLine(std::min(2 * y + 1, from.height() - 1)));
    auto* row = reinterpret_cast<QRgb*>(to.scanLine(y));
    for (int x = part.left(); x <= part.right(); ++x) {
      const int left = 2 * x, right = std::min(2 * x + 1, from.width() - 1);
      // Two bytes at a time: sums of four stay below 1024.
      const auto sum = [&](int shift) {
        return ((above[left] >> shift) & 0xff00ffu) + ((above[right] >> shift) & 0xff00ffu) +
               ((below[left] >> shift) & 0xff00ffu) + ((below[right] >> shift) & 0xff00ffu) + 0x20002u;
      };
      row[x] = ((sum(0) >> 2) & 0xff00ffu) | (((sum(8) >> 2) & 0xff00ffu) << 8);
    }
  }
}

void MipImage::draw(QPainter& painter, const QRectF& target, const QRectF& visible) const {
  if (isNull() || target.isEmpty()) return;
  const double scale = target.width() / size().width();
  std::size_t level = 0;
  for (double s = scale; s <= 0.5 && level + 1 < levels_.size(); s *= 2) ++level;
  const QImage& image = levels_[level];
  const double sx = image.width() / target.width(), sy = image.height() / target.height();
  const QRectF shown = target & visible;
  if (shown.isEmpty()) return;
  // Whole source pixels, with one more around for the filter.
  const QRect source =
      QRectF((shown.x() - target.x()) * sx, (shown.y() - target.y()) * sy, shown.width() * sx, shown.height() * sy)
          .toAlignedRect()
          .adjusted(-1, -1, 1, 1) &
      image.rect();
  const QRectF destination(target.x() + source.x() / sx, target.y() + source.y() / sy, source.width() / sx,
                           source.height() / sy);
  // Far in, single pixels should be seen.
  painter.setRenderHint(QPainter::SmoothPixmapTransform, scale < 3);
  painter.drawImage(destination, image, source);
}

}  // namespace windfall::widgets
