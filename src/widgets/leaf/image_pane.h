// The canvas of the leaf workspace: photo, a stage's picture over it, pan and zoom, events for the tools.
#pragma once

#include <QWidget>
#include <functional>

#include "widgets/leaf/legend.h"
#include "widgets/leaf/mip_image.h"
#include "widgets/tools/tool.h"

namespace windfall::widgets {

/// Space+drag or the middle button pan, the wheel zooms at the pointer, Ctrl+Space+drag zooms. Everything else with the
/// left button goes to the tools, in photo pixels.
class ImagePane : public QWidget {
  Q_OBJECT
 public:
  explicit ImagePane(QWidget* parent = nullptr);

  /// Another picture of the same size keeps the view.
  void setBase(MipImage base);
  const MipImage& base() const { return base_; }
  /// Stretched over the base; null: none.
  void setOverlay(MipImage overlay);
  const MipImage& overlay() const { return overlay_; }
  /// A part of the overlay, photo pixels.
  void replaceOverlay(const QImage& part, QPoint at);
  void setOverlayOpacity(double opacity);
  double overlayOpacity() const { return opacity_; }
  /// Shows the base at all (a variant stands alone on a checkerboard).
  void setBaseVisible(bool visible);
  /// What the tools draw, in photo pixels.
  void setToolPainter(std::function<void(QPainter&)> paint) { paintTool_ = std::move(paint); }
  void setToolCursor(Qt::CursorShape shape, bool pans);
  /// Offers Delete, Backspace, + and −, Alt+1 to 4 before any shortcut; `takes` false: they are left to the window.
  void setToolKeys(std::function<bool()> takes, std::function<bool(int, Qt::KeyboardModifiers)> key);
  /// Drawn in the lower left corner; empty: none.
  void setLegend(const Legend& legend);
  const Legend& legend() const { return legend_; }

  /// Screen pixels a photo pixel.
  double zoom() const { return zoom_; }
  void setZoom(double zoom);
  void zoomAt(QPointF screen, double factor);
  void fit();
  void fitWidth();
  bool isFitted() const { return fitted_; }
  QPointF center() const { return center_; }
  void setView(double zoom, QPointF center);
  QPointF toPhoto(QPointF screen) const;
  QPointF toScreen(QPointF photo) const;

 signals:
  void pressed(const windfall::widgets::ToolEvent& event);
  void moved(const windfall::widgets::ToolEvent& event);
  void released(const windfall::widgets::ToolEvent& event);
  /// Esc, or the focus was lost in a stroke.
  void cancelled();
  /// Photo position under the pointer, or the zoom changed.
  void pointed(QPointF photo);
  void viewChanged();

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void tabletEvent(QTabletEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  enum class Drag { None, Tool, Pan, Zoom };
  QRectF target() const;
  void begin(QPointF position, Qt::MouseButtons buttons, Qt::KeyboardModifiers modifiers, double pressure, qint64 time);
  void drag(QPointF position, Qt::MouseButtons buttons, Qt::KeyboardModifiers modifiers, double pressure, qint64 time);
  void end(QPointF position, Qt::KeyboardModifiers modifiers, qint64 time);
  void updateCursor();
  void viewed();

  MipImage base_, overlay_;
  double opacity_ = 1, zoom_ = 1;
  QPointF center_;  ///< photo px in the middle of the pane
  bool baseVisible_ = true, fitted_ = true, space_ = false, pans_ = false;
  Qt::CursorShape cursor_ = Qt::ArrowCursor;
  Drag drag_ = Drag::None;
  QPointF last_, pressedAt_;
  std::function<void(QPainter&)> paintTool_;
  std::function<bool()> takesKeys_;
  std::function<bool(int, Qt::KeyboardModifiers)> toolKey_;
  Legend legend_;
};

}  // namespace windfall::widgets
