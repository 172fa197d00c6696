#include "widgets/plant/crown_editor.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "model/plant/grow/crown_volume.h"

namespace windfall::widgets {

namespace {

constexpr double kWidest = 1.25;  ///< shares of the radius that fit on a side
constexpr double kGrip = 9;       ///< px

}  // namespace

CrownEditor::CrownEditor(QWidget* parent) : QWidget(parent) {
  setMinimumHeight(150);
  setFocusPolicy(Qt::StrongFocus);
  setToolTip(
      tr("The crown from the side. Drag its points, click to add one, right-click to take one away; a double click "
         "goes back to the formula."));
  setAccessibleName(tr("Crown outline"));
}

void CrownEditor::show(const model::CrownSettings& crown) {
  crown_ = crown;
  if (grabbed_ >= 0) return;
  points_ = crown.profile;
  if (points_.empty()) {
    for (const double u : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) points_.emplace_back(model::growth::crownRadius(crown, u), u);
  }
  update();
}

QPointF CrownEditor::toWidget(QPointF point) const {
  return {width() * (0.5 + 0.5 * point.x() / kWidest), 8 + (height() - 24) * (1 - point.y())};
}

QPointF CrownEditor::fromWidget(QPointF place) const {
  return {std::clamp((place.x() / width() - 0.5) * 2 * kWidest, -kWidest, kWidest),
          std::clamp(1 - (place.y() - 8) / (height() - 24), 0.0, 1.0)};
}

int CrownEditor::nearest(QPointF place) const {
  int best = -1;
  double least = kGrip;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const QPointF way = toWidget(points_[i]) - place;
    const double distance = std::hypot(way.x(), way.y());
    if (distance < least) least = distance, best = static_cast<int>(i);
  }
  return best;
}

void CrownEditor::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), palette().base());
  model::CrownSettings drawn = crown_;
  if (grabbed_ >= 0 || !crown_.profile.empty()) drawn.profile = points_;
  QPainterPath outline;
  constexpr int kSteps = 60;
  for (int side = 0; side < 2; ++side) {
    for (int i = 0; i <= kSteps; ++i) {
      const double u = static_cast<double>(side == 0 ? i : kSteps - i) / kSteps,
                   r = model::growth::crownRadius(drawn, u, side == 1);
      const QPointF place = toWidget({side == 0 ? r : -r, u});
      if (side == 0 && i == 0) {
        outline.moveTo(place);
      } else {
        outline.lineTo(place);
      }
    }
  }
  outline.closeSubpath();
  QColor fill = palette().highlight().color();
  fill.setAlpha(isEnabled() ? 70 : 30);
  painter.fillPath(outline, fill);
  painter.setPen(QPen(palette().highlight().color(), 1.5));
  painter.drawPath(outline);
  painter.setPen(QPen(palette().text().color(), 3));
  painter.drawLine(QPointF(width() / 2.0, height() - 2), toWidget({0, 0}));
  if (!isEnabled()) return;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    painter.setPen(QPen(palette().text().color(), 1));
    painter.setBrush(static_cast<int>(i) == chosen_ ? palette().highlight() : palette().window());
    painter.drawEllipse(toWidget(points_[i]), 4, 4);
  }
}

void CrownEditor::mousePressEvent(QMouseEvent* event) {
  const int hit = nearest(event->position());
  if (event->button() == Qt::RightButton) {
    remove(hit);
    return;
  }
  if (event->button() != Qt::LeftButton) return;
  ++gesture_;
  grabbed_ = hit;
  if (hit < 0) {
    points_.push_back(fromWidget(event->position()));
    grabbed_ = static_cast<int>(points_.size()) - 1;
    tell();
  }
  chosen_ = grabbed_;
  update();
}

void CrownEditor::mouseMoveEvent(QMouseEvent* event) {
  if (grabbed_ < 0) return;
  points_[static_cast<std::size_t>(grabbed_)] = fromWidget(event->position());
  tell();
  update();
}

void CrownEditor::mouseReleaseEvent(QMouseEvent*) { grabbed_ = -1; }

void CrownEditor::mouseDoubleClickEvent(QMouseEvent*) {
  grabbed_ = chosen_ = -1;
  ++gesture_;
  emit edited({}, {});
}

void CrownEditor::keyPressEvent(QKeyEvent* event) {
  if ((event->key() == Qt::Key_Delete || event->key() == Qt::Key_Backspace) && chosen_ >= 0) {
    remove(chosen_);
  } else {
    QWidget::keyPressEvent(event);
  }
}

void CrownEditor::remove(int index) {
  if (index < 0 || points_.size() <= 2) return;
  points_.erase(points_.begin() + index);
  chosen_ = -1;
  ++gesture_;
  tell();
  update();
}

void CrownEditor::tell() { emit edited(points_, QStringLiteral("crown %1").arg(gesture_)); }

}  // namespace windfall::widgets
