#include "widgets/plant/data_legend.h"

#include <QLocale>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace windfall::widgets {

namespace {

QColor toColor(std::uint32_t packed) {
  return QColor(static_cast<int>(packed & 255u), static_cast<int>(packed >> 8u & 255u),
                static_cast<int>(packed >> 16u & 255u));
}

}  // namespace

DataLegend::DataLegend(QWidget* parent) : QWidget(parent) {
  setObjectName("plant.legend");
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setVisible(false);
}

void DataLegend::show(model::PlantData what, const model::LinkData& shown) {
  what_ = what;
  data_ = shown;
  data_.values.clear();
  setVisible(what != model::PlantData::None);
  const QLocale locale;
  setAccessibleName(
      shown.known && !shown.named
          ? tr("Colours from %1 to %2 %3").arg(locale.toString(shown.low), locale.toString(shown.high), shown.unit)
          : QString());
  update();
}

QSize DataLegend::sizeHint() const { return {160, fontMetrics().height() + 22}; }

void DataLegend::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const int text = fontMetrics().height();
  const QRect bar(0, 4, width() - 1, height() - text - 10), line(0, height() - text - 2, width(), text);
  painter.setPen(palette().color(QPalette::WindowText));
  if (!data_.known) {
    painter.drawText(rect(), Qt::AlignCenter, tr("This plant's file says nothing of it"));
    return;
  }
  if (data_.named) {
    const int count = std::max(1, bar.width() / 14);
    for (int i = 0; i < count; ++i) {
      const QRect box(bar.x() + i * bar.width() / count, bar.y(), bar.width() / count - 2, bar.height());
      painter.fillRect(box, toColor(model::dataColor(what_, data_, static_cast<float>(i))));
    }
    painter.drawText(line, Qt::AlignCenter, tr("a colour a branch"));
    return;
  }
  for (int x = 0; x < bar.width(); ++x) {
    const double t = static_cast<double>(x) / std::max(1, bar.width() - 1);
    const bool decades = what_ == model::PlantData::Radius && data_.low > 0;
    const double value =
        decades ? data_.low * std::pow(data_.high / data_.low, t) : data_.low + (data_.high - data_.low) * t;
    painter.fillRect(bar.x() + x, bar.y(), 1, bar.height(),
                     toColor(model::dataColor(what_, data_, static_cast<float>(value))));
  }
  const QLocale locale;
  const auto number = [&](double value) {
    const int decimals = data_.high - data_.low >= 20 || what_ == model::PlantData::Order ? 0 : data_.high < 1 ? 2 : 1;
    return (locale.toString(value, 'f', decimals) + ' ' + data_.unit).trimmed();
  };
  painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, number(data_.low));
  painter.drawText(line, Qt::AlignRight | Qt::AlignVCenter, number(data_.high));
}

}  // namespace windfall::widgets
