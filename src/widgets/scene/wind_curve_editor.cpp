#include "widgets/scene/wind_curve_editor.h"

#include <QKeyEvent>
#include <QLocale>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "sim/wind_course.h"
#include "widgets/look/look.h"

namespace windfall::widgets {
namespace {

constexpr double kShortest = 20;  // s that are shown at least
constexpr double kWidest = 180;   // degrees at the lanes' border
constexpr double kGrip = 9;       // px
constexpr double kLeft = 34, kRight = 8, kGap = 8, kAxis = 16;
constexpr float kLeastGap = 0.1f;  // s between two points
constexpr float kMostStrength = 5;

}  // namespace

WindCurveEditor::WindCurveEditor(QWidget* parent) : QWidget(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setObjectName("wind.curve");
  setAccessibleName(tr("Wind over time"));
}

void WindCurveEditor::show(const sim::WindSettings& wind) {
  wind_ = wind;
  if (chosen_ >= static_cast<int>(wind_.curve.size())) chosen_ = -1;
  update();
}

void WindCurveEditor::setTime(double time) {
  if (time == time_) return;
  time_ = time;
  update();
}

double WindCurveEditor::span() const {
  if (dragging_) return frozenSpan_;
  const double last = wind_.course == sim::WindCourse::Recorded && !wind_.records.empty()
                          ? static_cast<double>(wind_.records.back().time)
                      : wind_.curve.empty() ? 0
                                            : static_cast<double>(wind_.curve.back().time);
  return wind_.course == sim::WindCourse::Recorded ? std::max(last, 1.0) : std::max(kShortest, last * 1.15);
}

double WindCurveEditor::strongest() const {
  if (dragging_) return frozenTop_;
  double top = 2;
  for (const sim::WindKey& key : wind_.curve) top = std::max(top, 1.1 * static_cast<double>(key.strength));
  return top;
}

QRectF WindCurveEditor::lane(bool turn) const {
  const double height = this->height() - kGap - kAxis - 6;
  const double upper = std::round(height * 0.62);
  const double width = this->width() - kLeft - kRight;
  return turn ? QRectF(kLeft, 4 + upper + kGap, width, height - upper) : QRectF(kLeft, 4, width, upper);
}

QPointF WindCurveEditor::place(double time, double value, bool turn) const {
  const QRectF area = lane(turn);
  const double share = turn ? 0.5 + 0.5 * value / kWidest : value / strongest();
  return {area.left() + area.width() * time / span(), area.bottom() - area.height() * std::clamp(share, 0.0, 1.0)};
}

QPointF WindCurveEditor::pointPlace(std::size_t index, bool turn) const {
  const sim::WindKey& key = wind_.curve[index];
  return place(static_cast<double>(key.time), static_cast<double>(turn ? key.turn : key.strength), turn);
}

WindCurveEditor::Grip WindCurveEditor::gripAt(QPointF position) const {
  Grip best;
  double nearest = kGrip;
  for (std::size_t i = 0; i < wind_.curve.size(); ++i) {
    for (const bool turn : {false, true}) {
      const QPointF d = pointPlace(i, turn) - position;
      const double distance = std::hypot(d.x(), d.y());
      if (distance < nearest) nearest = distance, best = {static_cast<int>(i), turn};
    }
  }
  return best;
}

void WindCurveEditor::apply(const std::vector<sim::WindKey>& curve, const QString& text, bool ends) {
  wind_.curve = curve;
  update();
  emit edited(curve, text, QStringLiteral("wind curve %1").arg(gesture_));
  if (ends) ++gesture_;
}

void WindCurveEditor::removePoint(int index) {
  if (index < 0 || wind_.curve.size() <= 1) return;
  std::vector<sim::WindKey> curve = wind_.curve;
  curve.erase(curve.begin() + index);
  chosen_ = -1;
  apply(curve, tr("Remove a point of the wind's curve"), true);
}

void WindCurveEditor::mousePressEvent(QMouseEvent* event) {
  if (!isEditable()) return;
  const Grip grip = gripAt(event->position());
  chosen_ = grip.point;
  update();
  if (grip.point < 0) return;
  if (event->button() == Qt::RightButton) {
    removePoint(grip.point);
  } else if (event->button() == Qt::LeftButton) {
    frozenSpan_ = span();
    frozenTop_ = strongest();
    drag_ = grip;
    dragging_ = true;
    ++gesture_;
  }
}

void WindCurveEditor::mouseMoveEvent(QMouseEvent* event) {
  if (!dragging_) {
    setCursor(isEditable() && gripAt(event->position()).point >= 0 ? Qt::SizeAllCursor : Qt::ArrowCursor);
    return;
  }
  std::vector<sim::WindKey> curve = wind_.curve;
  const auto i = static_cast<std::size_t>(drag_.point);
  sim::WindKey& key = curve[i];
  const QRectF area = lane(drag_.turn);
  const double share = std::clamp((area.bottom() - event->position().y()) / area.height(), 0.0, 1.0);
  if (drag_.turn) {
    key.turn = static_cast<float>(std::round((2 * share - 1) * kWidest));
    if (std::abs(key.turn) < 4) key.turn = 0;
  } else {
    key.strength = std::min(kMostStrength, static_cast<float>(std::round(100 * share * strongest()) / 100));
  }
  if (!(event->modifiers() & Qt::ShiftModifier)) {
    const float low = i > 0 ? curve[i - 1].time + kLeastGap : 0;
    const float high = i + 1 < curve.size() ? curve[i + 1].time - kLeastGap : 1e6f;
    const auto time = static_cast<float>((event->position().x() - area.left()) / area.width() * span());
    key.time = std::max(low, std::min(high, std::round(time * 20) / 20));
  }
  apply(curve, tr("Move a point of the wind's curve"), false);
  const QLocale locale;
  setToolTip({});
  QToolTip::showText(
      event->globalPosition().toPoint(),
      tr("%1 s   × %2   %3°")
          .arg(locale.toString(wind_.curve[i].time, 'f', 1), locale.toString(wind_.curve[i].strength, 'f', 2),
               locale.toString(wind_.curve[i].turn, 'f', 0)),
      this);
}

void WindCurveEditor::mouseReleaseEvent(QMouseEvent*) {
  if (!std::exchange(dragging_, false)) return;
  ++gesture_;
  update();
}

void WindCurveEditor::mouseDoubleClickEvent(QMouseEvent* event) {
  dragging_ = false;
  if (!isEditable() || event->button() != Qt::LeftButton || gripAt(event->position()).point >= 0) return;
  const bool turn = lane(true).adjusted(0, -kGap / 2, 0, 0).contains(event->position());
  const QRectF area = lane(turn);
  if (!area.adjusted(-kGrip, -kGrip, kGrip, kGrip).contains(event->position())) return;
  sim::WindKey key;
  key.time = std::max(0.f, static_cast<float>((event->position().x() - area.left()) / area.width() * span()));
  const sim::CurvePoint there = sim::curveAt(wind_.curve, key.time);
  key.strength = there.strength;
  key.turn = there.turn;
  const double share = std::clamp((area.bottom() - event->position().y()) / area.height(), 0.0, 1.0);
  (turn ? key.turn : key.strength) = static_cast<float>(turn ? (2 * share - 1) * kWidest : share * strongest());
  std::vector<sim::WindKey> curve = wind_.curve;
  const auto at = std::lower_bound(curve.begin(), curve.end(), key.time,
                                   [](const sim::WindKey& a, float time) { return a.time < time; });
  if (at != curve.end() && at->time - key.time < kLeastGap) return;
  if (at != curve.begin() && key.time - (at - 1)->time < kLeastGap) return;
  chosen_ = static_cast<int>(at - curve.begin());
  curve.insert(at, key);
  ++gesture_;
  apply(curve, tr("Add a point to the wind's curve"), true);
}

void WindCurveEditor::keyPressEvent(QKeyEvent* event) {
  if (!isEditable() || wind_.curve.empty()) return QWidget::keyPressEvent(event);
  const int count = static_cast<int>(wind_.curve.size());
  if (event->key() == Qt::Key_Delete || event->key() == Qt::Key_Backspace) return removePoint(chosen_);
  if (event->key() == Qt::Key_PageUp || event->key() == Qt::Key_PageDown) {
    chosen_ = std::clamp(chosen_ + (event->key() == Qt::Key_PageDown ? 1 : -1), 0, count - 1);
    return update();
  }
  if (chosen_ < 0) return QWidget::keyPressEvent(event);
  std::vector<sim::WindKey> curve = wind_.curve;
  sim::WindKey& key = curve[static_cast<std::size_t>(chosen_)];
  const bool turns = event->modifiers() & Qt::ControlModifier;
  const float sign = event->key() == Qt::Key_Up || event->key() == Qt::Key_Right ? 1.f : -1.f;
  if (event->key() == Qt::Key_Up || event->key() == Qt::Key_Down) {
    if (turns) {
      key.turn = std::clamp(key.turn + 5 * sign, -180.f, 180.f);
    } else {
      key.strength = std::clamp(key.strength + 0.05f * sign, 0.f, kMostStrength);
    }
  } else if (event->key() == Qt::Key_Left || event->key() == Qt::Key_Right) {
    const auto i = static_cast<std::size_t>(chosen_);
    const float low = i > 0 ? curve[i - 1].time + kLeastGap : 0;
    const float high = i + 1 < curve.size() ? curve[i + 1].time - kLeastGap : 1e6f;
    key.time = std::max(low, std::min(high, key.time + 0.25f * sign));
  } else {
    return QWidget::keyPressEvent(event);
  }
  apply(curve, tr("Move a point of the wind's curve"), true);
}

/// Keys that move a point are not the window's shortcuts while the editor has the focus.
bool WindCurveEditor::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && isEditable()) {
    switch (static_cast<QKeyEvent*>(event)->key()) {
      case Qt::Key_Delete:
      case Qt::Key_Left:
      case Qt::Key_Right:
      case Qt::Key_Up:
      case Qt::Key_Down:
        event->accept();
        return true;
      default:
        break;
    }
  }
  return QWidget::event(event);
}

void WindCurveEditor::paintLane(QPainter& painter, bool turn) const {
  const Colors& look = colors(palette());
  const QRectF area = lane(turn);
  painter.setPen(Qt::NoPen);
  painter.setBrush(look.field);
  painter.drawRoundedRect(area, 3, 3);
  painter.setPen(QPen(look.border, 1));
  const double middle = place(0, turn ? 0 : 1, turn).y();
  painter.drawLine(QPointF(area.left(), middle), QPointF(area.right(), middle));
  painter.setPen(look.muted);
  const QRectF label(0, 0, kLeft - 5, 14);
  const auto write = [&](double y, const QString& text) {
    painter.drawText(label.translated(0, std::clamp(y - 7, area.top() - 3, area.bottom() - 11)),
                     Qt::AlignRight | Qt::AlignVCenter, text);
  };
  const QLocale locale;
  const bool recorded = wind_.course == sim::WindCourse::Recorded;
  write(middle, turn ? tr("0°") : recorded ? tr("mean") : tr("× 1"));
  if (turn) {
    write(area.top(), tr("180°"));
  } else if (!recorded) {
    write(area.bottom(), tr("0"));
  }

  QPainterPath line;
  const double end = span();
  if (recorded) {
    const double mean = std::max(1e-3, static_cast<double>(wind_.speed));
    const std::size_t stride = std::max<std::size_t>(1, wind_.records.size() / 800);
    double shift = 0, last = 0;
    for (std::size_t i = 0; i < wind_.records.size(); i += stride) {
      const sim::WindRecord& row = wind_.records[i];
      double value = static_cast<double>(row.speed) / mean;
      if (turn) {
        value = static_cast<double>(row.heading - wind_.records.front().heading);
        value -= 360 * std::round(value / 360);
        shift = i > 0 && std::abs(value - last) > 180 ? 1 : 0;
        last = value;
      }
      const QPointF point = place(static_cast<double>(row.time), value, turn);
      i == 0 || shift > 0 ? line.moveTo(point) : line.lineTo(point);
    }
  } else {
    for (double x = 0; x <= area.width(); x += 1.5) {
      const double time = end * x / area.width();
      const sim::CurvePoint point = sim::curveAt(wind_.curve, static_cast<float>(time));
      const QPointF at = place(time, static_cast<double>(turn ? point.turn : point.strength), turn);
      x == 0 ? line.moveTo(at) : line.lineTo(at);
    }
  }
  painter.setClipRect(area);
  if (!turn && !recorded) {
    QPainterPath filled = line;
    filled.lineTo(area.right(), area.bottom());
    filled.lineTo(area.left(), area.bottom());
    QColor tint = look.accent;
    tint.setAlpha(36);
    painter.fillPath(filled, tint);
  }
  painter.setBrush(Qt::NoBrush);
  QColor stroke = turn ? look.muted : look.accent;
  painter.strokePath(line, QPen(stroke, 1.6, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  // The playhead; a course that repeats shows where it is in its round.
  const double length = recorded && !wind_.records.empty() ? static_cast<double>(wind_.records.back().time)
                        : wind_.curve.empty()              ? 0
                                                           : static_cast<double>(wind_.curve.back().time);
  const double now = wind_.repeat && length > 0 ? std::fmod(time_, length) : time_;
  if (now <= end) {
    const double x = area.left() + area.width() * now / end;
    painter.setPen(QPen(look.text, 1));
    painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
  }
  painter.setClipping(false);
  if (recorded) return;
  for (std::size_t i = 0; i < wind_.curve.size(); ++i) {
    const bool chosen = static_cast<int>(i) == chosen_;
    painter.setPen(QPen(chosen ? look.text : look.panel, 1.5));
    painter.setBrush(stroke);
    painter.drawEllipse(pointPlace(i, turn), chosen ? 5 : 4, chosen ? 5 : 4);
  }
}

void WindCurveEditor::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QFont small = font();
  small.setPointSizeF(small.pointSizeF() * 0.85);
  painter.setFont(small);
  for (const bool turn : {false, true}) paintLane(painter, turn);
  const Colors& look = colors(palette());
  const QRectF area = lane(true);
  const QLocale locale;
  painter.setPen(look.muted);
  const double rough = span() / 4, power = std::pow(10, std::floor(std::log10(rough)));
  const double step = rough / power < 2 ? 2 * power : rough / power < 5 ? 5 * power : 10 * power;
  for (double time = 0; time <= span() + 1e-6; time += step) {
    const double x = area.left() + area.width() * time / span();
    const QRectF label(std::min(x - 30, width() - 62.0), area.bottom() + 2, 60, kAxis - 2);
    painter.drawText(label, Qt::AlignHCenter | Qt::AlignTop, tr("%1 s").arg(locale.toString(time, 'g', 6)));
  }
}

}  // namespace windfall::widgets
