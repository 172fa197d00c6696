// The 3-D canvas: renderer, orbit camera and tools in one widget.
#pragma once

#include <QElapsedTimer>
#include <QOpenGLWidget>
#include <QTimer>
#include <QVariantAnimation>
#include <functional>
#include <memory>
#include <optional>

#include "widgets/render/renderer.h"
#include "widgets/viewport/frame_source.h"
#include "widgets/viewport/orbit_camera.h"
#include "widgets/viewport/viewport_tool.h"

class QLabel;

namespace windfall::widgets {

/// Paints only when asked to. Middle drag orbits, Shift+middle pans, Ctrl+middle and the wheel zoom at the pointer,
/// numpad 1 3 7 look from the front, the right and above (with Ctrl from the opposite side), `.` frames the selection,
/// Home all.
class Viewport : public QOpenGLWidget {
  Q_OBJECT
 public:
  explicit Viewport(QWidget* parent = nullptr);
  ~Viewport() override;

  /// May be null; must outlive the viewport or be set to null before it goes.
  void setSource(FrameSource* source);
  /// May be null; the caller keeps it.
  void setTool(ViewportTool* tool);

  const OrbitCamera& camera() const { return camera_; }
  void setCamera(const model::Camera& camera);
  /// Where the camera stands when its motion has ended.
  const model::Camera& cameraGoal() const { return goal_; }
  void frame(const Box& box);
  /// The same at once, or with the first picture, when the size of the view is known.
  void frameAtOnce(const Box& box);
  void look(StandardView view);
  /// What `.` and Home show; asked when the key is pressed.
  void setBounds(std::function<std::optional<Box>()> selection, std::function<std::optional<Box>()> all);

  /// Text in the canvas' middle while there is nothing to show; empty: none.
  void setHint(const QString& text);
  /// Why nothing can be drawn; empty while all is well.
  QString problem() const { return problem_; }
  /// Name of the renderer's device; empty before the first picture.
  QString rendererName() const;
  double lastDrawTime() const;
  /// Frames drawn so far.
  int drawnFrames() const { return drawn_; }
  bool isMoving() const { return animation_.state() == QAbstractAnimation::Running; }
  /// Smooth camera motion, milliseconds; 0: at once.
  void setMotionTime(int milliseconds) { motionTime_ = milliseconds; }
  void setQuality(render::Quality quality);
  /// Where a processor draws, standard pictures are coarse while something moves, and fine as soon as nothing does.
  void setCoarseWhileMoving(bool on);
  bool isCoarseWhileMoving() const { return coarseWhileMoving_; }
  /// Whether the last picture was a coarse one.
  bool isCoarse() const { return isCoarse_; }
  /// Key of the artist's choice in QSettings; what is not there counts as chosen.
  static constexpr auto kCoarseSetting = "view/coarseWhileMoving";
  QSize sizeHint() const override { return {960, 640}; }

 signals:
  void cameraChanged();
  void problemChanged(const QString& text);
  void drawn();

 protected:
  void initializeGL() override;
  void paintGL() override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  enum class Drag { None, Orbit, Pan, Zoom, Tool };
  ViewportEvent toEvent(const QMouseEvent& event) const;
  void moveTo(const model::Camera& goal, int milliseconds);
  void applyCamera(const OrbitCamera& camera);
  void releaseRenderer();
  void setProblem(const QString& text);
  void endDrag();

  std::unique_ptr<render::Renderer> renderer_;
  FrameSource* source_ = nullptr;
  ViewportTool* tool_ = nullptr;
  OrbitCamera camera_;
  model::Camera start_, goal_;
  QVariantAnimation animation_;
  int motionTime_ = 140;
  render::Quality quality_ = render::Quality::Standard;
  Drag drag_ = Drag::None;
  Qt::MouseButton dragButton_ = Qt::NoButton;
  QPointF pressed_, last_;
  bool clickable_ = false;
  std::function<std::optional<Box>()> selectionBounds_, allBounds_;
  std::optional<Box> awaited_;  ///< to be framed with the first picture
  QString problem_, hint_;
  QLabel* label_ = nullptr;
  QWidget* overlay_ = nullptr;
  int drawn_ = 0;
  bool coarseWhileMoving_ = true, isCoarse_ = false, refining_ = false;
  QTimer refine_;
};

}  // namespace windfall::widgets
