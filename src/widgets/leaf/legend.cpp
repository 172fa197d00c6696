#include "widgets/leaf/legend.h"

#include <QCoreApplication>
#include <QLocale>
#include <algorithm>

#include "widgets/look/look.h"

namespace windfall::widgets {

namespace {

constexpr int kBarWidth = 240, kBarHeight = 10, kPadding = 10, kSwatch = 12;

QString say(const char* text) { return QCoreApplication::translate("Legend", text); }

}  // namespace

QString fieldTitle(model::LeafField field) {
  switch (field) {
    case model::LeafField::Structural:
      return say(QT_TRANSLATE_NOOP("Legend", "Structural distance"));
    case model::LeafField::VeinDistance:
      return say(QT_TRANSLATE_NOOP("Legend", "Distance to veins"));
    case model::LeafField::Direction:
      return say(QT_TRANSLATE_NOOP("Legend", "Direction of veins"));
    case model::LeafField::Side:
      return say(QT_TRANSLATE_NOOP("Legend", "Side of the main vein"));
    case model::LeafField::Margin:
      return say(QT_TRANSLATE_NOOP("Legend", "Distance to the margin"));
  }
  return {};
}

Legend legendOf(model::LeafField field, const model::FieldScale& scale, double pixelsPerMetre) {
  Legend legend;
  legend.title = fieldTitle(field);
  if (scale.twoKinds) {
    legend.swatches = {{scale.ramp.front(), say(QT_TRANSLATE_NOOP("Legend", "left, from root to tip"))},
                       {scale.ramp.back(), say(QT_TRANSLATE_NOOP("Legend", "right"))}};
    return legend;
  }
  legend.ramp = scale.ramp;
  const QLocale locale;
  const bool millimetres = field == model::LeafField::VeinDistance && pixelsPerMetre > 0;
  switch (field) {
    case model::LeafField::Structural:
      legend.title += say(QT_TRANSLATE_NOOP("Legend", ", cost of the way from the root"));
      break;
    case model::LeafField::VeinDistance:
      legend.title += millimetres ? QStringLiteral(", mm") : QStringLiteral(", px");
      break;
    case model::LeafField::Margin:
      legend.title += say(QT_TRANSLATE_NOOP("Legend", ", share of half the widest"));
      break;
    default:
      break;
  }
  constexpr int kTicks = 4;
  for (int i = 0; i <= kTicks; ++i) {
    const double t = double(i) / kTicks;
    double value = scale.low + t * (scale.high - scale.low);
    if (millimetres) value *= 1000 / pixelsPerMetre;
    QString text = locale.toString(value, 'f', std::abs(scale.high) >= 20 && !millimetres ? 0 : 2);
    if (field == model::LeafField::Direction) text += QStringLiteral("°");
    legend.ticks.emplace_back(t, text);
  }
  return legend;
}

void drawLegend(QPainter& painter, const Legend& legend, const QRect& area, const Colors& c) {
  if (legend.isEmpty()) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const QFontMetrics metrics(painter.font());
  const int line = metrics.height();
  const bool bar = legend.swatches.empty();
  int inner = std::max(kBarWidth, metrics.horizontalAdvance(legend.title));
  for (const auto& [colour, text] : legend.swatches) {
    inner = std::max(inner, kSwatch + 8 + metrics.horizontalAdvance(text));
  }
  const int rows = bar ? kBarHeight + 6 + line : int(legend.swatches.size()) * (line + 4);
  QRect box(0, 0, inner + 2 * kPadding + 16, 2 * kPadding + line + 6 + rows);
  box.moveBottomLeft(area.bottomLeft());
  QColor ground = c.panel;
  ground.setAlphaF(0.92f);
  painter.setPen(Qt::NoPen);
  painter.setBrush(ground);
  painter.drawRoundedRect(box, 5, 5);
  painter.setPen(c.text);
  const int left = box.left() + kPadding + 8;
  int y = box.top() + kPadding;
  painter.drawText(QRect(left, y, inner, line), Qt::AlignLeft | Qt::AlignVCenter, legend.title);
  y += line + 6;
  if (bar) {
    QLinearGradient gradient(left, 0, left + kBarWidth, 0);
    for (size_t i = 0; i < legend.ramp.size(); ++i) {
      gradient.setColorAt(double(i) / double(std::max<size_t>(1, legend.ramp.size() - 1)), QColor(legend.ramp[i]));
    }
    painter.setPen(Qt::NoPen);
    painter.setBrush(gradient);
    painter.drawRect(QRect(left, y, kBarWidth, kBarHeight));
    painter.setPen(c.muted);
    for (const auto& [place, text] : legend.ticks) {
      const int x = left + int(place * kBarWidth);
      painter.drawLine(x, y + kBarHeight, x, y + kBarHeight + 3);
      const int wide = metrics.horizontalAdvance(text);
      painter.drawText(QRect(x - wide / 2 - 1, y + kBarHeight + 4, wide + 2, line), Qt::AlignCenter, text);
    }
  } else {
    for (const auto& [colour, text] : legend.swatches) {
      painter.setPen(Qt::NoPen);
      painter.setBrush(QColor(colour));
      painter.drawRoundedRect(QRect(left, y + (line - kSwatch) / 2, kSwatch, kSwatch), 2, 2);
      painter.setPen(c.muted);
      painter.drawText(QRect(left + kSwatch + 8, y, inner, line), Qt::AlignLeft | Qt::AlignVCenter, text);
      y += line + 4;
    }
  }
  painter.restore();
}

}  // namespace windfall::widgets
