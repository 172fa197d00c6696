// A bare window round one workspace: canvas, inspector, strip and menu, for tests with real events.
#pragma once

#include <QApplication>
#include <QHBoxLayout>
#include <QMainWindow>
#include <QMenuBar>
#include <QtTest>

#include "widgets/look/look.h"
#include "widgets/workspace.h"

namespace windfall::test {

class WorkspaceWindow : public QMainWindow {
 public:
  explicit WorkspaceWindow(widgets::Workspace& workspace) : workspace_(workspace) {
    widgets::applyLook(*qApp, widgets::Scheme::Dark);
    auto* middle = new QWidget;
    auto* column = new QVBoxLayout(middle);
    auto* row = new QHBoxLayout;
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    row->setSpacing(0);
    row->addWidget(workspace.canvas(), 1);
    workspace.inspector()->setFixedWidth(304);
    row->addWidget(workspace.inspector());
    column->addLayout(row, 1);
    workspace.strip()->setFixedHeight(84);
    column->addWidget(workspace.strip());
    setCentralWidget(middle);
    workspace.fillMenu(*menuBar()->addMenu(workspace.title()));
    if (QWidget* corner = workspace.corner()) menuBar()->setCornerWidget(corner);
    for (QAction* tool : workspace.tools()) addAction(tool);
  }

  /// Shows the window and waits until the workspace has drawn all there is.
  bool open(QSize size = {800, 600}) {
    resize(size);
    show();
    if (!QTest::qWaitForWindowActive(this)) return false;
    workspace_.activate();
    return settle();
  }

  bool settle() {
    return QTest::qWaitFor([this] { return workspace_.isSettled(); }, 20000);
  }

 private:
  widgets::Workspace& workspace_;
};

}  // namespace windfall::test
