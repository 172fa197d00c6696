// Paints a variant of the gallery: the leaf on a checkerboard, its seed, its heart, its scores.
#pragma once

#include <QStyledItemDelegate>

namespace windfall::widgets {

/// Roles of the gallery's items.
inline constexpr int kVariantImage = Qt::UserRole + 1;  ///< QImage
inline constexpr int kVariantKeep = Qt::UserRole + 2;   ///< bool
inline constexpr int kVariantSeed = Qt::UserRole + 3;   ///< quint64

inline constexpr int kVariantScore = Qt::UserRole + 4;  ///< QString: one short line; empty until known

class VariantDelegate : public QStyledItemDelegate {
  Q_OBJECT
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override { return {108, 140}; }
  /// Where the heart of an item lies.
  static QRect heartOf(const QRect& item);
};

}  // namespace windfall::widgets
