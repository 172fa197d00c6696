// The parts of the main window and its menus.
#include <QActionGroup>
#include <QApplication>
#include <QDesktopServices>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QShortcut>
#include <QStackedWidget>
#include <QStandardPaths>
#include <QStatusBar>
#include <QToolBar>
#include <QToolButton>
#include <QUrl>

#include "widgets/look/empty_state.h"
#include "widgets/look/icon.h"
#include "widgets/main_window/asset_tree.h"
#include "widgets/main_window/command_palette.h"
#include "widgets/main_window/dock.h"
#include "widgets/main_window/jobs_indicator.h"
#include "widgets/main_window/main_window.h"
#include "widgets/main_window/message_bar.h"
#include "widgets/main_window/project_files.h"
#include "widgets/main_window/recent_files.h"
#include "widgets/viewport/viewport.h"

namespace windfall::widgets {

void MainWindow::buildTopBar() {
  auto* bar = new QToolBar(tr("Workspaces"), this);
  bar->setObjectName(QStringLiteral("topBar"));
  bar->setMovable(false);
  bar->setFloatable(false);
  bar->toggleViewAction()->setVisible(false);
  topBar_ = new QWidget(bar);
  auto* grid = new QGridLayout(topBar_);
  grid->setContentsMargins(kGrid, 0, kGrid, 0);
  const auto makeRow = [this] {
    auto* row = new QWidget(topBar_);
    auto* box = new QHBoxLayout(row);
    box->setContentsMargins(0, 0, 0, 0);
    box->setSpacing(kGrid);
    return row;
  };
  tabRow_ = makeRow();
  cornerRow_ = makeRow();
  cornerRow_->layout()->addWidget(new JobsIndicator(context_.jobs, cornerRow_));
  cornerRow_->layout()->setSpacing(4 * kGrid);
  title_ = new QLabel(topBar_);
  title_->setProperty("hint", true);
  grid->addWidget(tabRow_, 0, 0, Qt::AlignLeft);
  grid->addWidget(title_, 0, 1, Qt::AlignCenter);
  grid->addWidget(cornerRow_, 0, 2, Qt::AlignRight);
  grid->setColumnStretch(0, 1);
  grid->setColumnStretch(2, 1);
  topBar_->setMinimumHeight(36);
  topBar_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  bar->addWidget(topBar_);
  addToolBar(Qt::TopToolBarArea, bar);

  toolBar_ = new QToolBar(tr("Tools"), this);
  toolBar_->setObjectName(QStringLiteral("toolBar"));
  toolBar_->setIconSize({20, 20});
  toolBar_->setMovable(true);
  toolBar_->setFloatable(false);
  toolBar_->setToolButtonStyle(Qt::ToolButtonIconOnly);
  addToolBar(Qt::LeftToolBarArea, toolBar_);
}

void MainWindow::buildDocks() {
  canvases_ = new QStackedWidget(this);
  welcome_ = new EmptyState(QStringLiteral("windfall"), tr("Leaves, trees and wind"),
                            tr("Drop a leaf photo, a tree or a project here, or begin with one of these."), canvases_);
  const auto begin = [this](const QString& text, const QString& iconName, bool primary, auto slot) {
    connect(welcome_->addButton(text, iconName, primary), &QPushButton::clicked, this, slot);
  };
  begin(tr("Open a leaf photo…"), QStringLiteral("photo"), true, [this] {
    openWorkspace(QStringLiteral("leaf"));
    if (current_) current_->add();
  });
  begin(tr("Import a tree…"), QStringLiteral("plant"), false, [this] {
    openWorkspace(QStringLiteral("plant"));
    if (current_) current_->add();
  });
  sampleButton_ = welcome_->addButton(tr("Open the sample"), QStringLiteral("windfall"));
  connect(sampleButton_, &QPushButton::clicked, this, [this] { files_->openSample(); });
  begin(tr("Open a project…"), QStringLiteral("open"), false, [this] { files_->open(); });
  connect(welcome_, &EmptyState::linkActivated, files_, &ProjectFiles::openPath);
  canvases_->addWidget(welcome_);
  setCentralWidget(canvases_);
  auto* hide = new QShortcut(QKeySequence(Qt::Key_Tab), canvases_);
  hide->setContext(Qt::WidgetWithChildrenShortcut);
  connect(hide, &QShortcut::activated, this, &MainWindow::toggleDocks);

  assetDock_ = new Dock(QStringLiteral("assets"), tr("Assets"), this);
  assets_ = new AssetTree(context_.document, assetDock_);
  assetDock_->setWidget(assets_);
  addDockWidget(Qt::RightDockWidgetArea, assetDock_);
  inspectorDock_ = new Dock(QStringLiteral("inspector"), tr("Inspector"), this);
  inspectors_ = new QStackedWidget(inspectorDock_);
  inspectorDock_->setWidget(inspectors_);
  addDockWidget(Qt::RightDockWidgetArea, inspectorDock_);
  stripDock_ = new Dock(QStringLiteral("strip"), tr("Strip"), this);
  strips_ = new QStackedWidget(stripDock_);
  stripDock_->setWidget(strips_);
  addDockWidget(Qt::BottomDockWidgetArea, stripDock_);
  // The strip below the canvas only: the inspector needs the height.
  setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  resizeDocks({assetDock_, inspectorDock_}, {220, 520}, Qt::Vertical);
  resizeDocks({inspectorDock_}, {344}, Qt::Horizontal);
  resizeDocks({stripDock_}, {176}, Qt::Vertical);
}

void MainWindow::buildStatusBar() {
  messages_ = new MessageBar(this);
  status_ = new QLabel(this);
  status_->setProperty("hint", true);
  status_->setContentsMargins(2 * kGrid, 0, 2 * kGrid, 0);
  statusBar()->addWidget(messages_, 1);
  statusBar()->addPermanentWidget(status_);
  statusBar()->setSizeGripEnabled(false);
  statusBar()->setMinimumHeight(28);
}

void MainWindow::fillRecent(QMenu& menu) {
  menu.clear();
  for (const QString& path : recentFiles()) {
    connect(menu.addAction(QFileInfo(path).fileName()), &QAction::triggered, files_,
            [this, path] { files_->openPath(path); });
  }
  if (menu.isEmpty()) menu.addAction(tr("None yet"))->setEnabled(false);
}

void MainWindow::buildMenus() {
  const auto add = [this](QMenu* menu, const QString& text, const QString& iconName, const QList<QKeySequence>& keys,
                          auto slot) {
    QAction* action = menu->addAction(iconName.isEmpty() ? QIcon() : icon(iconName), text);
    action->setShortcuts(keys);
    connect(action, &QAction::triggered, this, slot);
    return action;
  };
  QMenu* file = menuBar()->addMenu(tr("&File"));
  add(file, tr("&New"), QStringLiteral("new"), {QKeySequence::New}, [this] { files_->newProject(); });
  add(file, tr("&Open…"), QStringLiteral("open"), {QKeySequence::Open}, [this] { files_->open(); });
  QMenu* recent = file->addMenu(icon(QStringLiteral("clock")), tr("Open &Recent"));
  connect(recent, &QMenu::aboutToShow, this, [this, recent] { fillRecent(*recent); });
  sampleAction_ = add(file, tr("Open the Sam&ple"), QStringLiteral("windfall"), {}, [this] { files_->openSample(); });
  file->addSeparator();
  add(file, tr("&Save"), QStringLiteral("save"), {QKeySequence(QStringLiteral("Ctrl+S"))}, [this] { files_->save(); });
  add(file, tr("Save &As…"), {}, {QKeySequence(QStringLiteral("Ctrl+Shift+S"))}, [this] { files_->saveAs(); });
  file->addSeparator();
  add(file, tr("&Export"), QStringLiteral("export"), {QKeySequence(QStringLiteral("Ctrl+E"))}, [this] {
    if (current_) current_->exportResult(false);
  });
  add(file, tr("Export &Elsewhere…"), {}, {QKeySequence(QStringLiteral("Ctrl+Shift+E"))}, [this] {
    if (current_) current_->exportResult(true);
  });
  file->addSeparator();
  add(file, tr("&Quit"), {}, {QKeySequence(QStringLiteral("Ctrl+Q"))}, [this] { close(); });

  QMenu* edit = menuBar()->addMenu(tr("&Edit"));
  QUndoStack& stack = context_.document.undoStack();
  QAction* undo = stack.createUndoAction(this, tr("&Undo"));
  undo->setIcon(icon(QStringLiteral("undo")));
  undo->setShortcut(QKeySequence(QStringLiteral("Ctrl+Z")));
  QAction* redo = stack.createRedoAction(this, tr("&Redo"));
  redo->setIcon(icon(QStringLiteral("redo")));
  redo->setShortcuts({QKeySequence(QStringLiteral("Ctrl+Shift+Z")), QKeySequence(QStringLiteral("Ctrl+Y"))});
  edit->addAction(undo);
  edit->addAction(redo);
  edit->addSeparator();
  edit->addActions({assets_->renameAction(), assets_->duplicateAction(), assets_->deleteAction()});
  edit->addSeparator();
  add(edit, tr("&Keyboard Shortcuts…"), QStringLiteral("settings"), {}, [this] { editShortcuts(); });

  viewMenu_ = menuBar()->addMenu(tr("&View"));
  add(viewMenu_, tr("Show or Hide &Docks"), QStringLiteral("eye"), {}, [this] {
    toggleDocks();
  })->setToolTip(tr("Tab, while the canvas has the focus"));
  add(viewMenu_, tr("&Full Screen"), QStringLiteral("frame"), {QKeySequence(Qt::Key_F11)},
      [this] { setWindowState(windowState() ^ Qt::WindowFullScreen); });
  QAction* coarse = viewMenu_->addAction(tr("&Coarse While Moving"));
  coarse->setObjectName(QStringLiteral("coarseWhileMoving"));
  coarse->setCheckable(true);
  coarse->setChecked(QSettings().value(Viewport::kCoarseSetting, true).toBool());
  coarse->setToolTip(tr("Without a graphics card, 3-D views shade one pixel in four until nothing moves"));
  connect(coarse, &QAction::toggled, this, [this](bool on) {
    QSettings().setValue(Viewport::kCoarseSetting, on);
    for (Viewport* viewport : findChildren<Viewport*>()) viewport->setCoarseWhileMoving(on);
  });
  viewMenu_->addSeparator();
  add(viewMenu_, tr("Da&rk"), {}, {}, [this] { setScheme(Scheme::Dark); });
  add(viewMenu_, tr("&Light"), QStringLiteral("sun"), {}, [this] { setScheme(Scheme::Light); });

  // The workspaces' menus come in between.
  windowMenu_ = menuBar()->addMenu(tr("&Window"));
  firstAfterWorkspaces_ = windowMenu_->addSeparator();
  for (Dock* dock : {assetDock_, inspectorDock_, stripDock_}) windowMenu_->addAction(dock->toggleViewAction());
  windowMenu_->addAction(toolBar_->toggleViewAction());
  windowMenu_->addSeparator();
  add(windowMenu_, tr("&Reset Layout"), QStringLiteral("reset"), {}, [this] { resetLayout(); });

  QMenu* help = menuBar()->addMenu(tr("&Help"));
  add(help, tr("Find &Action…"), QStringLiteral("search"), {QKeySequence(QStringLiteral("Ctrl+Shift+P"))},
      [this] { commandPalette_->open(allActions()); });
  add(help, tr("Show &Log"), {}, {}, [] {
    QDesktopServices::openUrl(QUrl::fromLocalFile(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation)));
  });
  add(help, tr("About &Windfall"), QStringLiteral("info"), {}, [this] {
    messages_->showMessage(
        tr("Windfall %1: leaves, trees and wind for artists").arg(QApplication::applicationVersion()), false);
  });
}

}  // namespace windfall::widgets
