#include "widgets/viewport/viewport.h"

#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QSettings>
#include <QWheelEvent>
#include <cmath>
#include <utility>

namespace windfall::widgets {
namespace {

constexpr int kStandardMotion = 220;   // ms, for views and framing
constexpr int kRest = 250;             // ms without a new picture before a coarse one is drawn finely
constexpr double kClickRadius = 4;     // px that a click may wander
constexpr double kPixelsPerStep = 30;  // of a zooming drag

/// Draws the tool's handles above the picture, without OpenGL.
class Overlay : public QWidget {
 public:
  Overlay(QWidget* parent, std::function<void(QPainter&)> paint) : QWidget(parent), paint_(std::move(paint)) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    paint_(painter);
  }

 private:
  std::function<void(QPainter&)> paint_;
};

}  // namespace

Viewport::Viewport(QWidget* parent) : QOpenGLWidget(parent) {
  QSurfaceFormat format;
  format.setVersion(4, 5);
  format.setProfile(QSurfaceFormat::CoreProfile);
  setFormat(format);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(160, 120);
  setAccessibleName(tr("3-D view"));
  overlay_ = new Overlay(this, [this](QPainter& painter) {
    if (tool_ != nullptr) tool_->paint(painter, camera_, size());
  });
  overlay_->hide();
  label_ = new QLabel(this);
  label_->setAlignment(Qt::AlignCenter);
  label_->setWordWrap(true);
  label_->setAttribute(Qt::WA_TransparentForMouseEvents);
  label_->setObjectName("canvasHint");
  label_->hide();
  coarseWhileMoving_ = QSettings().value(kCoarseSetting, true).toBool();
  refine_.setSingleShot(true);
  connect(&refine_, &QTimer::timeout, this, [this] {
    refining_ = true;
    update();
  });
  // From when it is seen, not from when it was asked for: a processor may take longer than the rest.
  connect(this, &QOpenGLWidget::frameSwapped, this, [this] {
    if (isCoarse_) refine_.start(kRest);
  });
  goal_ = camera_.state();
  animation_.setStartValue(0.0);
  animation_.setEndValue(1.0);
  animation_.setEasingCurve(QEasingCurve::OutCubic);
  connect(&animation_, &QVariantAnimation::valueChanged, this,
          [this](const QVariant& share) { applyCamera(OrbitCamera(between(start_, goal_, share.toDouble()))); });
}

Viewport::~Viewport() {
  releaseRenderer();
  // The base class destroys the context, when this is no Viewport any more.
  if (context() != nullptr) disconnect(context(), nullptr, this, nullptr);
}

void Viewport::setSource(FrameSource* source) {
  if (source_ == source) return;
  if (source_ != nullptr) source_->release();
  source_ = source;
  update();
}

void Viewport::setTool(ViewportTool* tool) {
  if (tool_ == tool) return;
  endDrag();
  tool_ = tool;
  overlay_->setVisible(tool_ != nullptr);
  overlay_->update();
}

void Viewport::setCamera(const model::Camera& camera) {
  animation_.stop();
  awaited_.reset();
  goal_ = camera;
  applyCamera(OrbitCamera(camera));
}

void Viewport::applyCamera(const OrbitCamera& camera) {
  camera_ = camera;
  update();
  overlay_->update();
  emit cameraChanged();
}

void Viewport::moveTo(const model::Camera& goal, int milliseconds) {
  animation_.stop();
  if (motionTime_ == 0) {
    setCamera(goal);
    return;
  }
  start_ = camera_.state();
  goal_ = goal;
  animation_.setDuration(milliseconds);
  animation_.start();
}

void Viewport::frame(const Box& box) {
  OrbitCamera camera(goal_);
  camera.frame(box, size());
  moveTo(camera.state(), kStandardMotion);
}

void Viewport::frameAtOnce(const Box& box) {
  if (drawn_ == 0) {
    awaited_ = box;
    return;
  }
  OrbitCamera camera(goal_);
  camera.frame(box, size());
  setCamera(camera.state());
}

void Viewport::look(StandardView view) {
  OrbitCamera camera(goal_);
  camera.look(view);
  moveTo(camera.state(), kStandardMotion);
}

void Viewport::setBounds(std::function<std::optional<Box>()> selection, std::function<std::optional<Box>()> all) {
  selectionBounds_ = std::move(selection);
  allBounds_ = std::move(all);
}

void Viewport::setHint(const QString& text) {
  hint_ = text;
  const QString& shown = problem_.isEmpty() ? hint_ : problem_;
  label_->setText(shown);
  label_->setVisible(!shown.isEmpty());
  label_->raise();
}

void Viewport::setProblem(const QString& text) {
  if (problem_ == text) return;
  problem_ = text;
  setHint(hint_);
  emit problemChanged(text);
}

QString Viewport::rendererName() const { return renderer_ ? QString::fromStdString(renderer_->name()) : QString(); }

double Viewport::lastDrawTime() const { return renderer_ ? renderer_->lastDrawTime() : 0; }

void Viewport::setQuality(render::Quality quality) {
  quality_ = quality;
  update();
}

void Viewport::setCoarseWhileMoving(bool on) {
  coarseWhileMoving_ = on;
  update();
}

void Viewport::initializeGL() {
  // Moved to another window, the widget gets another context: what lived in the old one goes with it.
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &Viewport::releaseRenderer, Qt::UniqueConnection);
  Result<std::unique_ptr<render::Renderer>> renderer = render::Renderer::create();
  if (renderer) {
    renderer_ = std::move(*renderer);
    setProblem({});
  } else {
    setProblem(tr("The 3-D view %1").arg(QString::fromStdString(renderer.error().message)));
  }
}

void Viewport::releaseRenderer() {
  if (!renderer_) return;
  if (source_ != nullptr) source_->release();
  makeCurrent();
  renderer_.reset();
  doneCurrent();
}

void Viewport::paintGL() {
  if (!renderer_) return;
  if (awaited_) {
    OrbitCamera camera(goal_);
    camera.frame(*awaited_, size());
    setCamera(camera.state());
  }
  render::View view;
  view.eye = camera_.eye();
  view.target = camera_.target();
  view.fieldOfView = static_cast<float>(camera_.state().fieldOfView * 3.14159265358979 / 180);
  view.width = static_cast<int>(std::lround(width() * devicePixelRatioF()));
  view.height = static_cast<int>(std::lround(height() * devicePixelRatioF()));
  view.quality = quality_;
  const bool refining = std::exchange(refining_, false);
  view.coarse = coarseWhileMoving_ && !refining && quality_ == render::Quality::Standard && renderer_->isSoftware();
  isCoarse_ = view.coarse;
  refine_.stop();
  if (source_ != nullptr) {
    source_->prepare(*renderer_);
    source_->describe(view);
  }
  const Status drawn = renderer_->draw(view, defaultFramebufferObject());
  setProblem(drawn ? QString() : QString::fromStdString(drawn.error().message));
  ++drawn_;
  if (renderer_->lastDraw().unfinished) QTimer::singleShot(15, this, [this] { update(); });
  emit this->drawn();
}

void Viewport::showEvent(QShowEvent* event) {
  QOpenGLWidget::showEvent(event);
  // Where no context can be had at all, Qt never calls initializeGL.
  QTimer::singleShot(0, this, [this] {
    if (isVisible() && !isValid()) setProblem(tr("The 3-D view needs OpenGL 4.5, which this display does not offer."));
  });
}

void Viewport::resizeEvent(QResizeEvent* event) {
  QOpenGLWidget::resizeEvent(event);
  overlay_->setGeometry(rect());
  label_->setGeometry(rect().adjusted(24, 24, -24, -24));
}

ViewportEvent Viewport::toEvent(const QMouseEvent& event) const {
  return {event.position(), event.button(), event.modifiers(), camera_, size()};
}

void Viewport::mousePressEvent(QMouseEvent* event) {
  if (drag_ != Drag::None) return;
  setFocus(Qt::MouseFocusReason);
  pressed_ = last_ = event->position();
  dragButton_ = event->button();
  clickable_ = false;
  animation_.stop();
  goal_ = camera_.state();
  if (event->button() == Qt::MiddleButton) {
    drag_ = event->modifiers() & Qt::ShiftModifier     ? Drag::Pan
            : event->modifiers() & Qt::ControlModifier ? Drag::Zoom
                                                       : Drag::Orbit;
  } else if (event->button() == Qt::LeftButton) {
    if (tool_ != nullptr && tool_->press(toEvent(*event))) {
      drag_ = Drag::Tool;
    } else {
      drag_ = Drag::Orbit;
      clickable_ = true;
    }
  }
}

void Viewport::mouseMoveEvent(QMouseEvent* event) {
  const QPointF moved = event->position() - last_;
  if (clickable_ && (event->position() - pressed_).manhattanLength() < kClickRadius) return;
  clickable_ = false;
  last_ = event->position();
  OrbitCamera camera = camera_;
  switch (drag_) {
    case Drag::None:
      return;
    case Drag::Tool:
      tool_->move(toEvent(*event));
      overlay_->update();
      return;
    case Drag::Orbit:
      camera.orbit(moved);
      break;
    case Drag::Pan:
      camera.pan(moved, size());
      break;
    case Drag::Zoom:
      camera.zoom(-moved.y() / kPixelsPerStep, pressed_, size());
      break;
  }
  goal_ = camera.state();
  applyCamera(camera);
}

void Viewport::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != dragButton_) return;
  const Drag drag = std::exchange(drag_, Drag::None);
  dragButton_ = Qt::NoButton;
  if (drag == Drag::Tool) {
    tool_->release(toEvent(*event));
  } else if (clickable_ && tool_ != nullptr) {
    tool_->click(toEvent(*event));
  }
  overlay_->update();
}

void Viewport::endDrag() {
  if (drag_ == Drag::Tool && tool_ != nullptr) tool_->cancel();
  drag_ = Drag::None;
  dragButton_ = Qt::NoButton;
  overlay_->update();
}

void Viewport::wheelEvent(QWheelEvent* event) {
  OrbitCamera camera(goal_);
  camera.zoom(event->angleDelta().y() / 120.0, event->position(), size());
  moveTo(camera.state(), motionTime_);
  event->accept();
}

void Viewport::keyPressEvent(QKeyEvent* event) {
  const bool opposite = event->modifiers() & Qt::ControlModifier;
  const bool keypad = event->modifiers() & Qt::KeypadModifier;
  if (keypad && event->key() == Qt::Key_1) {
    look(opposite ? StandardView::Back : StandardView::Front);
  } else if (keypad && event->key() == Qt::Key_3) {
    look(opposite ? StandardView::Left : StandardView::Right);
  } else if (keypad && event->key() == Qt::Key_7) {
    look(StandardView::Top);
  } else if (event->key() == Qt::Key_Period || event->key() == Qt::Key_Home) {
    std::optional<Box> box;
    if (event->key() == Qt::Key_Period && selectionBounds_) box = selectionBounds_();
    if (!box && allBounds_) box = allBounds_();
    if (box) frame(*box);
  } else if (event->key() == Qt::Key_Escape && drag_ == Drag::Tool) {
    endDrag();
  } else {
    QOpenGLWidget::keyPressEvent(event);
  }
}

void Viewport::focusOutEvent(QFocusEvent* event) {
  QOpenGLWidget::focusOutEvent(event);
  if (!isVisible()) endDrag();
}

}  // namespace windfall::widgets
