// Single-colour line icons that follow the palette.
#pragma once

#include <QColor>
#include <QIcon>
#include <QPixmap>
#include <QString>

namespace windfall::widgets {

/// The icon `:/icons/NAME.svg`: the text's colour, faint when disabled, the accent when checked; drawn anew when the
/// palette changes. An unknown name gives a null icon.
QIcon icon(const QString& name);

/// The same picture in one given colour.
QPixmap iconPixmap(const QString& name, int size, const QColor& color, qreal devicePixelRatio = 1);

}  // namespace windfall::widgets
