#include "widgets/leaf/variant_delegate.h"

#include <QImage>
#include <QPainter>
#include <QPixmapCache>

#include "widgets/look/icon.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

namespace {

constexpr int kPicture = 96;  // px

/// Where there is anything to see; a leaf fills little of its photo.
QRect opaquePart(const QImage& image) {
  const QImage small = image.scaled(64, 64).convertToFormat(QImage::Format_ARGB32);
  QRect part;
  for (int y = 0; y < 64; ++y) {
    const auto* row = reinterpret_cast<const QRgb*>(small.constScanLine(y));
    for (int x = 0; x < 64; ++x) {
      if (qAlpha(row[x]) > 24) part |= QRect(x, y, 1, 1);
    }
  }
  if (part.isEmpty()) return image.rect();
  part.adjust(-1, -1, 1, 1);
  return QRect(part.x() * image.width() / 64, part.y() * image.height() / 64, part.width() * image.width() / 64,
               part.height() * image.height() / 64) &
         image.rect();
}

QPixmap thumbnail(const QImage& image, qreal ratio) {
  const QString key = QStringLiteral("variant/%1/%2").arg(image.cacheKey()).arg(ratio);
  QPixmap pixmap;
  if (QPixmapCache::find(key, &pixmap)) return pixmap;
  pixmap = QPixmap::fromImage(
      image.copy(opaquePart(image))
          .convertToFormat(QImage::Format_ARGB32_Premultiplied)
          .scaled(QSize(kPicture - 8, kPicture - 8) * ratio, Qt::KeepAspectRatio, Qt::SmoothTransformation));
  pixmap.setDevicePixelRatio(ratio);
  QPixmapCache::insert(key, pixmap);
  return pixmap;
}

}  // namespace

QRect VariantDelegate::heartOf(const QRect& item) { return {item.right() - 27, item.bottom() - 38, 20, 20}; }

void VariantDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
  const Colors& c = colors(option.palette);
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  const bool selected = option.state & QStyle::State_Selected;
  const bool keep = index.data(kVariantKeep).toBool();
  const QRect cell = option.rect.adjusted(3, 2, -3, -1);
  painter->setPen(Qt::NoPen);
  if (selected || option.state & QStyle::State_MouseOver) {
    painter->setBrush(selected ? c.selected : c.hover);
    painter->drawRoundedRect(cell, 6, 6);
  }
  QRect frame(cell.left() + (cell.width() - kPicture) / 2, cell.top() + 3, kPicture, kPicture);
  painter->setBrush(c.canvas);
  painter->drawRoundedRect(frame, 4, 4);
  const QPixmap picture = thumbnail(index.data(kVariantImage).value<QImage>(), painter->device()->devicePixelRatioF());
  QRectF at(QPointF(), picture.deviceIndependentSize());
  at.moveCenter(QRectF(frame).center());
  painter->setOpacity(keep ? 1 : 0.35);
  painter->drawPixmap(at.topLeft(), picture);
  painter->setOpacity(1);
  painter->setPen(selected ? c.text : c.muted);
  QFont small = option.font;
  small.setPointSizeF(small.pointSizeF() * 0.9);
  painter->setFont(small);
  const QRect heart = heartOf(option.rect);
  painter->drawText(QRect(frame.left() + 2, heart.top(), 70, heart.height()), Qt::AlignLeft | Qt::AlignVCenter,
                    QString::number(index.data(kVariantSeed).toULongLong()));
  painter->drawText(QRect(frame.left() + 2, heart.bottom() - 1, kPicture - 4, 16), Qt::AlignLeft | Qt::AlignVCenter,
                    index.data(kVariantScore).toString());
  painter->drawPixmap(heart.adjusted(3, 3, -3, -3),
                      iconPixmap(keep ? QStringLiteral("heart-filled") : QStringLiteral("heart"), 14,
                                 keep ? c.accent : c.muted, painter->device()->devicePixelRatioF()));
  painter->restore();
}

}  // namespace windfall::widgets
