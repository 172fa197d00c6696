#include "widgets/leaf/image_pane.h"

#include <QMouseEvent>
#include <QPainter>
#include <cmath>

#include "widgets/look/look.h"

namespace windfall::widgets {

namespace {

constexpr double kMinZoom = 0.02, kMaxZoom = 64;
constexpr int kMargin = 24;  // px around a fitted picture
constexpr int kCheck = 8;    // px, side of a checkerboard square

void drawCheckerboard(QPainter& painter, const QRectF& area, const Colors& c) {
  const bool dark = c.canvas.lightness() < 128;
  QPixmap tile(2 * kCheck, 2 * kCheck);
  tile.fill(dark ? QColor(58, 62, 60) : QColor(236, 238, 236));
  QPainter inside(&tile);
  const QColor other = dark ? QColor(72, 77, 74) : QColor(255, 255, 255);
  inside.fillRect(0, 0, kCheck, kCheck, other);
  inside.fillRect(kCheck, kCheck, kCheck, kCheck, other);
  inside.end();
  painter.drawTiledPixmap(area.toRect(), tile);
}

}  // namespace

ImagePane::ImagePane(QWidget* parent) : QWidget(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMinimumSize(160, 120);
}

void ImagePane::setBase(MipImage base) {
  // A view that was set before the picture came (a reopened project) stays.
  const bool keep = base.size() == base_.size() || (base_.isNull() && !fitted_);
  base_ = std::move(base);
  if (!keep) fit();
  update();
}

void ImagePane::setOverlay(MipImage overlay) {
  overlay_ = std::move(overlay);
  update();
}

void ImagePane::replaceOverlay(const QImage& part, QPoint at) {
  overlay_.replace(part, at);
  const QRectF area(toScreen(at), toScreen(at + QPoint(part.width(), part.height())));
  update(area.toAlignedRect().adjusted(-2, -2, 2, 2));
}

void ImagePane::setOverlayOpacity(double opacity) {
  opacity_ = opacity;
  update();
}

void ImagePane::setBaseVisible(bool visible) {
  baseVisible_ = visible;
  update();
}

void ImagePane::setToolCursor(Qt::CursorShape shape, bool pans) {
  cursor_ = shape;
  pans_ = pans;
  updateCursor();
}

QRectF ImagePane::target() const { return QRectF(toScreen({0, 0}), QSizeF(base_.size()) * zoom_); }

QPointF ImagePane::toPhoto(QPointF screen) const {
  return center_ + (screen - QPointF(width() / 2.0, height() / 2.0)) / zoom_;
}

QPointF ImagePane::toScreen(QPointF photo) const {
  return QPointF(width() / 2.0, height() / 2.0) + (photo - center_) * zoom_;
}

void ImagePane::viewed() {
  update();
  emit viewChanged();
}

void ImagePane::setZoom(double zoom) {
  zoom_ = std::clamp(zoom, kMinZoom, kMaxZoom);
  fitted_ = false;
  viewed();
}

void ImagePane::setView(double zoom, QPointF center) {
  center_ = center;
  setZoom(zoom);
}

void ImagePane::zoomAt(QPointF screen, double factor) {
  const QPointF held = toPhoto(screen);
  zoom_ = std::clamp(zoom_ * factor, kMinZoom, kMaxZoom);
  fitted_ = false;
  center_ += held - toPhoto(screen);
  viewed();
}

void ImagePane::fit() {
  fitted_ = true;
  if (base_.isNull()) return;
  zoom_ = std::min(double(width() - 2 * kMargin) / base_.size().width(),
                   double(height() - 2 * kMargin) / base_.size().height());
  zoom_ = std::clamp(zoom_, kMinZoom, kMaxZoom);
  center_ = QPointF(base_.size().width() / 2.0, base_.size().height() / 2.0);
  viewed();
}

void ImagePane::fitWidth() {
  if (base_.isNull()) return;
  center_.setX(base_.size().width() / 2.0);
  setZoom(double(width() - 2 * kMargin) / base_.size().width());
}

void ImagePane::resizeEvent(QResizeEvent*) {
  if (fitted_) fit();
}

void ImagePane::paintEvent(QPaintEvent* event) {
  const Colors& c = colors(palette());
  QPainter painter(this);
  painter.fillRect(event->rect(), c.canvas);
  if (base_.isNull()) return;
  const QRectF area = target();
  const QRectF visible = event->rect();
  if (!baseVisible_ || base_.hasAlpha()) drawCheckerboard(painter, area, c);
  if (baseVisible_) base_.draw(painter, area, visible);
  if (!overlay_.isNull()) {
    painter.setOpacity(opacity_);
    overlay_.draw(painter, area, visible);
    painter.setOpacity(1);
  }
  if (paintTool_) {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.translate(area.topLeft());
    painter.scale(zoom_, zoom_);
    paintTool_(painter);
    painter.restore();
  }
  drawLegend(painter, legend_, rect().marginsRemoved({12, 12, 12, 12}), c);
}

void ImagePane::setLegend(const Legend& legend) {
  legend_ = legend;
  update();
}

void ImagePane::setToolKeys(std::function<bool()> takes, std::function<bool(int, Qt::KeyboardModifiers)> key) {
  takesKeys_ = std::move(takes);
  toolKey_ = std::move(key);
}

bool ImagePane::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && takesKeys_ && takesKeys_()) {
    const auto* key = static_cast<QKeyEvent*>(event);
    const bool order = key->modifiers() & Qt::AltModifier && key->key() >= Qt::Key_1 && key->key() <= Qt::Key_4;
    switch (key->key()) {
      case Qt::Key_Delete:
      case Qt::Key_Backspace:
      case Qt::Key_Plus:
      case Qt::Key_Equal:
      case Qt::Key_Minus:
        event->accept();
        return true;
      default:
        if (!order) break;
        event->accept();
        return true;
    }
  }
  return QWidget::event(event);
}

void ImagePane::begin(QPointF position, Qt::MouseButtons buttons, Qt::KeyboardModifiers modifiers, double pressure,
                      qint64 time) {
  last_ = pressedAt_ = position;
  if (drag_ != Drag::None || base_.isNull()) return;
  if (buttons & Qt::LeftButton && space_ && modifiers & Qt::ControlModifier) {
    drag_ = Drag::Zoom;
  } else if (buttons & Qt::MiddleButton || (buttons & Qt::LeftButton && (space_ || pans_))) {
    drag_ = Drag::Pan;
  } else if (buttons & Qt::LeftButton) {
    drag_ = Drag::Tool;
    emit pressed({toPhoto(position), buttons, modifiers, pressure, time});
  }
  updateCursor();
}

void ImagePane::drag(QPointF position, Qt::MouseButtons buttons, Qt::KeyboardModifiers modifiers, double pressure,
                     qint64 time) {
  if (drag_ == Drag::Pan) {
    center_ -= (position - last_) / zoom_;
    fitted_ = false;
    viewed();
  } else if (drag_ == Drag::Zoom) {
    zoomAt(pressedAt_, std::exp((position.x() - last_.x()) / 150));
  } else if (!base_.isNull()) {
    emit moved({toPhoto(position), buttons, modifiers, pressure, time});
  }
  last_ = position;
  emit pointed(toPhoto(position));
}

void ImagePane::end(QPointF position, Qt::KeyboardModifiers modifiers, qint64 time) {
  const Drag ended = std::exchange(drag_, Drag::None);
  if (ended == Drag::Tool) emit released({toPhoto(position), Qt::NoButton, modifiers, 0, time});
  updateCursor();
}

void ImagePane::mousePressEvent(QMouseEvent* event) {
  begin(event->position(), event->button(), event->modifiers(), 1, qint64(event->timestamp()));
}

void ImagePane::mouseMoveEvent(QMouseEvent* event) {
  drag(event->position(), event->buttons(), event->modifiers(), 1, qint64(event->timestamp()));
}

void ImagePane::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::MiddleButton && drag_ != Drag::Pan) return;
  end(event->position(), event->modifiers(), qint64(event->timestamp()));
}

void ImagePane::tabletEvent(QTabletEvent* event) {
  const qint64 time = qint64(event->timestamp());
  if (event->type() == QEvent::TabletPress) {
    begin(event->position(), event->buttons(), event->modifiers(), event->pressure(), time);
  } else if (event->type() == QEvent::TabletMove) {
    drag(event->position(), event->buttons(), event->modifiers(), event->pressure(), time);
  } else if (event->type() == QEvent::TabletRelease) {
    end(event->position(), event->modifiers(), time);
  }
  event->accept();
}

void ImagePane::wheelEvent(QWheelEvent* event) {
  zoomAt(event->position(), std::pow(1.2, event->angleDelta().y() / 120.0));
  event->accept();
}

void ImagePane::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) {
    drag_ = Drag::None;
    emit cancelled();
  } else if (event->key() == Qt::Key_Space) {
    if (!event->isAutoRepeat()) space_ = true;
  } else if (!toolKey_ || !toolKey_(event->key(), event->modifiers())) {
    QWidget::keyPressEvent(event);
  }
  updateCursor();
}

void ImagePane::keyReleaseEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Space && !event->isAutoRepeat()) {
    space_ = false;
    updateCursor();
  } else {
    QWidget::keyReleaseEvent(event);
  }
}

void ImagePane::focusOutEvent(QFocusEvent* event) {
  QWidget::focusOutEvent(event);
  space_ = false;
  if (drag_ == Drag::Tool) emit cancelled();
  drag_ = Drag::None;
  updateCursor();
}

void ImagePane::updateCursor() {
  if (base_.isNull()) return setCursor(Qt::ArrowCursor);
  if (drag_ == Drag::Pan) return setCursor(Qt::ClosedHandCursor);
  setCursor(space_ ? Qt::OpenHandCursor : cursor_);
}

}  // namespace windfall::widgets
