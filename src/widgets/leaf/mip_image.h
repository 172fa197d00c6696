// A picture with its halves, quarters, …, so that any zoom draws fast and without shimmer.
#pragma once

#include <QImage>
#include <QRectF>
#include <vector>

class QPainter;

namespace windfall::widgets {

class MipImage {
 public:
  MipImage() = default;
  explicit MipImage(const QImage& image);

  bool isNull() const { return levels_.empty(); }
  QSize size() const { return isNull() ? QSize() : levels_.front().size(); }
  bool hasAlpha() const { return alpha_; }
  const QImage& full() const { return levels_.front(); }
  /// Replaces a part, and what it covers in the smaller levels.
  void replace(const QImage& part, QPoint at);
  /// Draws the whole picture into `target`, but only what lies in `visible`; both in the painter's pixels.
  void draw(QPainter& painter, const QRectF& target, const QRectF& visible) const;

 private:
  void halve(std::size_t level, QRect part);

  std::vector<QImage> levels_;  ///< ARGB32_Premultiplied
  bool alpha_ = false;
};

}  // namespace windfall::widgets
