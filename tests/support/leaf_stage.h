// What tests of the leaf workspace in the real window share: an editor with painted leaves, and hands to work it.
#pragma once

#include <QAction>
#include <QApplication>
#include <QtTest>
#include <memory>

#include "app/editor.h"
#include "support/painted_leaf.h"
#include "support/suite.h"
#include "widgets/leaf/image_pane.h"
#include "widgets/leaf/leaf_workspace.h"
#include "widgets/look/look.h"
#include "widgets/main_window/message_bar.h"

namespace windfall::test {

/// A base of test classes. Places are pixels of the photo.
class LeafStage {
 protected:
  /// The window with the leaf workspace in it, showing the first of `leaves`; nothing is to be undone. False: it does
  /// not open.
  bool open(const std::vector<model::Leaf>& leaves = {paintedLeaf()}, QSize size = {1440, 900}) {
    widgets::applyLook(*qApp, widgets::Scheme::Dark);
    editor_ = std::make_unique<app::Editor>();
    editor_->window().resize(size);
    ids_.clear();
    for (const model::Leaf& leaf : leaves) ids_.push_back(editor_->document().addLeaf(leaf));
    id_ = ids_.front();
    undo().clear();
    leaf_ = qobject_cast<widgets::LeafWorkspace*>(editor_->window().workspace(QStringLiteral("leaf")));
    if (!leaf_) return false;
    pane_ = &leaf_->pane();
    editor_->window().openWorkspace(QStringLiteral("leaf"));
    editor_->window().show();
    if (!QTest::qWaitForWindowActive(&editor_->window())) return false;
    leaf_->show(id_);
    return settle();
  }
  /// Where undoneToTheStart leads back to.
  void remember() {
    undo().clear();
    before_ = editor_->document().project();
  }
  /// Every edit taken back gives the first state.
  bool undoneToTheStart() {
    while (undo().canUndo()) QTest::keyClick(pane_, Qt::Key_Z, Qt::ControlModifier);
    if (!settle()) return false;
    model::Project now = editor_->document().project();
    now.view = before_.view;
    return now == before_;
  }

  const model::Leaf& shown() { return *editor_->document().project().leaf(id_); }
  QUndoStack& undo() { return editor_->document().undoStack(); }
  bool settle(int seconds = 60) { return editor_->settle(seconds); }
  QString said() { return editor_->window().messages().text(); }
  /// An error of one line.
  bool saidWrong() { return editor_->window().messages().isError() && !said().isEmpty() && !said().contains('\n'); }

  static QPoint on(widgets::ImagePane& pane, QPointF photo) { return pane.toScreen(photo).toPoint(); }
  /// Presses at the first place and moves over the others; sent as events, for the pointer itself may be anywhere.
  void press(const QList<QPointF>& photo, Qt::KeyboardModifiers modifiers = {}) {
    QTest::mousePress(pane_, Qt::LeftButton, modifiers, on(*pane_, photo.first()));
    for (const QPointF& point : photo.mid(1)) {
      const QPoint place = on(*pane_, point);
      QMouseEvent move(QEvent::MouseMove, place, pane_->mapToGlobal(place), Qt::NoButton, Qt::LeftButton, modifiers);
      QApplication::sendEvent(pane_, &move);
    }
  }
  void release(QPointF photo, Qt::KeyboardModifiers modifiers = {}) {
    QTest::mouseRelease(pane_, Qt::LeftButton, modifiers, on(*pane_, photo));
  }
  void drag(const QList<QPointF>& photo, Qt::KeyboardModifiers modifiers = {}) {
    press(photo, modifiers);
    release(photo.last(), modifiers);
  }
  void click(QPointF photo, Qt::KeyboardModifiers modifiers = {}) { drag({photo}, modifiers); }

  /// The menu entry of that text; null: there is none.
  QAction* entry(const QString& text) {
    for (QAction* action : editor_->window().findChildren<QAction*>()) {
      if (action->text().remove(QLatin1Char('&')) == text) return action;
    }
    return nullptr;
  }
  bool trigger(const QString& text) {
    QAction* action = entry(text);
    if (action) action->trigger();
    return action != nullptr;
  }
  bool shot(const char* name) {
    return editor_->window().grab().save(outputFolder() + QLatin1Char('/') + QLatin1String(name));
  }

  std::unique_ptr<app::Editor> editor_;
  widgets::LeafWorkspace* leaf_ = nullptr;
  widgets::ImagePane* pane_ = nullptr;
  std::vector<model::AssetId> ids_;
  model::AssetId id_;  ///< the first
  model::Project before_;
};

}  // namespace windfall::test
