// Where a processor draws, the 3-D view is coarse at first and while it moves, and fine when nothing does.
#include <QSettings>
#include <QtTest>
#include <algorithm>

#include "support/suite.h"
#include "widgets/viewport/viewport.h"

using namespace windfall;
using widgets::Viewport;

class ViewportRefinementTest : public QObject {
  Q_OBJECT
 private slots:
  void init() {
    view_ = std::make_unique<Viewport>();
    view_->setMotionTime(0);
    view_->resize(240, 160);
    coarse_.clear();
    connect(view_.get(), &Viewport::drawn, this, [this] { coarse_.push_back(view_->isCoarse()); });
  }
  void cleanup() {
    view_.reset();
    QSettings().remove(Viewport::kCoarseSetting);
  }

  void theFirstPictureIsCoarseAndTheNextFine() {
    if (!show()) return;
    QVERIFY(coarse_.front());
    QTRY_VERIFY(!coarse_.back());
  }

  void aMovedCameraIsSeenCoarselyAndThenFinely() {
    if (!show()) return;
    QTRY_VERIFY(!coarse_.back());
    const std::size_t before = coarse_.size();
    QTest::keyClick(view_.get(), Qt::Key_7, Qt::KeypadModifier);
    QTRY_VERIFY(coarse_.size() > before);
    QVERIFY(coarse_[before]);
    QTRY_VERIFY(!coarse_.back());
  }

  void whoWantsNoCoarsePicturesGetsNone() {
    view_->setCoarseWhileMoving(false);
    if (!show()) return;
    const std::size_t before = coarse_.size();
    QTest::keyClick(view_.get(), Qt::Key_7, Qt::KeypadModifier);
    QTRY_VERIFY(coarse_.size() > before);
    QVERIFY(std::ranges::none_of(coarse_, [](bool coarse) { return coarse; }));
  }

  void theChoiceIsRemembered() {
    QSettings().setValue(Viewport::kCoarseSetting, false);
    QVERIFY(!Viewport().isCoarseWhileMoving());
    QSettings().remove(Viewport::kCoarseSetting);
    QVERIFY(Viewport().isCoarseWhileMoving());
  }

 private:
  /// False, with the test skipped by name, where a graphics card draws.
  bool show() {
    view_->show();
    if (!QTest::qWaitFor([&] { return !coarse_.empty(); })) {
      QTest::qFail("nothing was drawn", __FILE__, __LINE__);
      return false;
    }
    const QString name = view_->rendererName();
    if (name.contains(QLatin1String("llvmpipe")) || name.contains(QLatin1String("softpipe"))) return true;
    QTest::qSkip("a graphics card draws here", __FILE__, __LINE__);
    return false;
  }

  std::unique_ptr<Viewport> view_;
  std::vector<bool> coarse_;
};

WINDFALL_SUITE(ViewportRefinementTest)
#include "viewport_refinement.moc"
