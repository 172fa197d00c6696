// What tests of one workspace share: a document, the workspace in its window, and hands to work it.
#pragma once

#include <memory>

#include "support/workspace_window.h"
#include "widgets/viewport/viewport.h"

namespace windfall::test {

/// A base of test classes; `W` is the workspace.
template <class W>
class WorkspaceStage {
 protected:
  /// The window with its viewport's camera at once where it goes, drawn plainly. False: it does not open.
  bool open(QSize size = {800, 600}) {
    document_ = std::make_unique<model::Document>();
    jobs_ = std::make_unique<model::JobRunner>();
    workspace_ = std::make_unique<W>(widgets::WorkspaceContext{*document_, *jobs_});
    window_ = std::make_unique<WorkspaceWindow>(*workspace_);
    view().setMotionTime(0);
    view().setQuality(render::Quality::Draft);
    return window_->open(size) && view().problem().isEmpty();
  }
  void close() {
    window_.reset();
    workspace_.reset();
    jobs_.reset();
    document_.reset();
  }
  widgets::Viewport& view() { return workspace_->viewport(); }
  template <class F>
  F* field(const char* name) {
    return window_->findChild<F*>(name);
  }
  /// With the button held; sent as events, for the pointer itself may be anywhere.
  static void drag(QWidget* on, QPoint from, QPoint to, Qt::KeyboardModifiers modifiers = {}) {
    QTest::mousePress(on, Qt::LeftButton, modifiers, from);
    for (int i = 1; i <= 4; ++i) {
      const QPoint at = from + (to - from) * i / 4;
      QMouseEvent move(QEvent::MouseMove, at, on->mapToGlobal(at), Qt::NoButton, Qt::LeftButton, modifiers);
      QApplication::sendEvent(on, &move);
    }
    QTest::mouseRelease(on, Qt::LeftButton, modifiers, to);
  }
  /// Matrices of the links as they stand now; empty: none came.
  std::vector<mat4> pose() {
    std::vector<mat4> taken;
    workspace_->controller().requestPose([&](const std::vector<mat4>& now) { taken = now; });
    return QTest::qWaitFor([&] { return !taken.empty(); }) ? taken : std::vector<mat4>();
  }

  std::unique_ptr<model::Document> document_;
  std::unique_ptr<model::JobRunner> jobs_;
  std::unique_ptr<W> workspace_;
  std::unique_ptr<WorkspaceWindow> window_;
};

/// A small grown tree with the id 1, and as many of it in a row, with ids from 2, in a wind that takes leaves.
inline model::Project saplings(int trees) {
  model::Project project;
  model::Plant plant;
  plant.id = {1};
  plant.name = "Sapling";
  plant.grower = model::GrowerSettings{.height = 4, .baseRadius = 0.05, .limbs = 6, .levels = 2};
  project.plants = {plant};
  for (int i = 0; i < trees; ++i) {
    model::TreePlacement tree;
    tree.id = {static_cast<quint64>(2 + i)};
    tree.plant = plant.id;
    tree.position = {4.f * static_cast<float>(i) - 2, 0, 0};
    project.scene.trees.push_back(tree);
  }
  if (trees > 0) project.scene.leaves.count = 60, project.scene.wind.speed = 10;
  project.nextId = 2 + static_cast<quint64>(trees);
  return project;
}

}  // namespace windfall::test
