#include "widgets/main_window/main_window.h"

#include <QActionGroup>
#include <QApplication>
#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QJsonObject>
#include <QLabel>
#include <QLayout>
#include <QMenuBar>
#include <QMimeData>
#include <QPushButton>
#include <QSettings>
#include <QStackedWidget>
#include <QToolBar>
#include <QToolButton>
#include <algorithm>

#include "widgets/look/empty_state.h"
#include "widgets/look/icon.h"
#include "widgets/main_window/asset_tree.h"
#include "widgets/main_window/command_palette.h"
#include "widgets/main_window/dock.h"
#include "widgets/main_window/message_bar.h"
#include "widgets/main_window/project_files.h"
#include "widgets/main_window/recent_files.h"
#include "widgets/main_window/shortcut_dialog.h"
#include "widgets/main_window/shortcut_table.h"

namespace windfall::widgets {

namespace {
constexpr int kStateVersion = 1;
const QString kScheme = QStringLiteral("look/light");
const char* const kWorkspaceOfKind[] = {"leaf", "plant", "scene"};
}  // namespace

MainWindow::MainWindow(WorkspaceContext context, QWidget* parent)
    : QMainWindow(parent), context_(context), files_(new ProjectFiles(context.document, context.jobs, this)) {
  setObjectName(QStringLiteral("mainWindow"));
  setWindowIcon(icon(QStringLiteral("windfall")));
  setAcceptDrops(true);
  setAnimated(false);
  setDockNestingEnabled(true);
  setContextMenuPolicy(Qt::NoContextMenu);
  resize(1440, 900);
  buildTopBar();
  buildDocks();
  buildStatusBar();
  shortcuts_ = new ShortcutTable(this);
  buildMenus();
  commandPalette_ = new CommandPalette(this);

  model::Document& document = context_.document;
  connect(files_, &ProjectFiles::message, messages_, &MessageBar::showMessage);
  connect(files_, &ProjectFiles::aboutToSave, this, &MainWindow::storeView);
  connect(&context_.jobs, &model::JobRunner::failed, this, [this](const QString& title, const QString& text) {
    messages_->showMessage(tr("%1: %2").arg(title, text), true);
  });
  connect(&document, &model::Document::modifiedChanged, this, &MainWindow::updateTitle);
  connect(&document, &model::Document::changed, this, [this](const model::Change& change) {
    if (change.aspect == model::Aspect::Everything) {
      updateTitle();
      restoreView();
    }
    if (change.aspect == model::Aspect::Everything || change.aspect == model::Aspect::Assets) updateWelcome();
  });
  connect(assets_, &AssetTree::chosen, this,
          [this](model::AssetId asset, AssetKind kind) { showAsset(asset, kind, false); });
  connect(assets_, &AssetTree::opened, this,
          [this](model::AssetId asset, AssetKind kind) { showAsset(asset, kind, true); });
  connect(assets_, &AssetTree::addRequested, this, [this](AssetKind kind) {
    openWorkspace(QLatin1String(kWorkspaceOfKind[int(kind)]));
    if (current_) current_->add();
  });
  updateTitle();
}

MainWindow::~MainWindow() {
  if (current_) current_->deactivate();
  current_ = nullptr;
  // Before the widgets that they made and still speak to.
  for (const Tab& tab : tabs_) delete tab.workspace;
  tabs_.clear();
}

void MainWindow::addWorkspace(Workspace* workspace) {
  workspace->setParent(this);
  Tab tab{.workspace = workspace, .button = new QToolButton(tabRow_), .menu = nullptr, .action = nullptr, .docks = {}};
  tab.button->setProperty("workspaceTab", true);
  tab.button->setText(workspace->title());
  tab.button->setIcon(icon(workspace->id()));
  tab.button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  tab.button->setIconSize({16, 16});
  tab.button->setCheckable(true);
  tab.button->setAutoExclusive(true);
  tab.button->setFocusPolicy(Qt::NoFocus);
  // The style leaves room for an arrow that there is not.
  constexpr int kTabPadding = 2 * 12 + 16 + 4;
  tab.button->setFixedWidth(tab.button->fontMetrics().horizontalAdvance(tab.button->text()) + kTabPadding);
  tabRow_->layout()->addWidget(tab.button);
  if (QWidget* corner = workspace->corner()) cornerRow_->layout()->addWidget(corner);

  canvases_->addWidget(workspace->canvas());
  inspectors_->addWidget(workspace->inspector());
  strips_->addWidget(workspace->strip());
  tab.menu = new QMenu(workspace->title(), this);
  menuBar()->insertMenu(windowMenu_->menuAction(), tab.menu);
  workspace->fillMenu(*tab.menu);

  const std::size_t index = tabs_.size();
  tab.action = new QAction(icon(workspace->id()), workspace->title(), this);
  tab.action->setShortcut(QKeySequence(QStringLiteral("Ctrl+%1").arg(index + 1)));
  windowMenu_->insertAction(firstAfterWorkspaces_, tab.action);
  connect(tab.action, &QAction::triggered, this, [this, index] { switchTo(index); });
  connect(tab.button, &QToolButton::clicked, this, [this, index] { switchTo(index); });
  // What is chosen from another workspace's menu should be seen.
  connect(tab.menu, &QMenu::triggered, this, [this, index] { switchTo(index); });
  connect(workspace, &Workspace::message, messages_, &MessageBar::showMessage);
  connect(workspace, &Workspace::status, this, [this, workspace](const QString& text) {
    if (workspace == current_) status_->setText(text);
  });
  tabs_.push_back(std::move(tab));
  setShortcutsOn(tabs_.back(), false);
}

void MainWindow::start() {
  defaultDocks_ = saveState(kStateVersion);
  sampleAction_->setVisible(files_->hasSample());
  sampleButton_->setVisible(files_->hasSample());
  const QSettings settings;
  restoreGeometry(settings.value(QStringLiteral("window/geometry")).toByteArray());
  for (Tab& tab : tabs_) {
    tab.docks = settings.value(QStringLiteral("window/docks/") + tab.workspace->id()).toByteArray();
  }
  registerShortcuts();
  if (!tabs_.empty()) switchTo(0);
  restoreView();
  updateWelcome();
}

Workspace* MainWindow::workspace(const QString& id) const {
  for (const Tab& tab : tabs_) {
    if (tab.workspace->id() == id) return tab.workspace;
  }
  return nullptr;
}

void MainWindow::openWorkspace(const QString& id) {
  for (std::size_t i = 0; i < tabs_.size(); ++i) {
    if (tabs_[i].workspace->id() == id) return switchTo(i);
  }
}

QList<QAction*> MainWindow::actionsOf(const QMenu& menu) {
  QList<QAction*> found;
  const QList<QAction*> entries = menu.actions();
  for (QAction* action : entries) {
    if (const QMenu* inner = action->menu()) {
      found << actionsOf(*inner);
    } else if (!action->isSeparator()) {
      found << action;
    }
  }
  return found;
}

void MainWindow::setShortcutsOn(const Tab& tab, bool on) {
  // Two workspaces may use the same letter; only the shown one has the keys.
  const QList<QAction*> actions = actionsOf(*tab.menu) + tab.workspace->tools();
  for (QAction* action : actions) {
    shortcuts_->add(action, tab.workspace->title(), tab.workspace->id());
    action->setShortcuts(on ? shortcuts_->of(action) : QList<QKeySequence>());
  }
}

void MainWindow::registerShortcuts() {
  const QList<QAction*> menus = menuBar()->actions();
  for (const QAction* entry : menus) {
    const auto isOfWorkspace = [&](const Tab& tab) { return tab.menu == entry->menu(); };
    if (std::ranges::any_of(tabs_, isOfWorkspace)) continue;
    // Without submenus: those list files, not actions.
    const QList<QAction*> actions = entry->menu()->actions();
    for (QAction* action : actions) {
      if (!action->menu() && !action->isSeparator()) shortcuts_->add(action, entry->text());
    }
  }
  connect(shortcuts_, &ShortcutTable::changed, this, [this](QAction* action) {
    const QString workspace = shortcuts_->workspaceOf(action);
    if (workspace.isEmpty() || (current_ && current_->id() == workspace)) action->setShortcuts(shortcuts_->of(action));
  });
}

void MainWindow::editShortcuts() {
  auto* dialog = new ShortcutDialog(*shortcuts_, this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->open();
}

void MainWindow::switchTo(std::size_t index) {
  Tab& tab = tabs_[index];
  tab.button->setChecked(true);
  if (tab.workspace == current_) return;
  for (Tab& other : tabs_) {
    if (other.workspace != current_) continue;
    current_->deactivate();
    other.docks = saveState(kStateVersion);
    setShortcutsOn(other, false);
  }
  current_ = tab.workspace;
  hidden_.clear();
  canvases_->setCurrentWidget(current_->canvas());
  inspectors_->setCurrentWidget(current_->inspector());
  strips_->setCurrentWidget(current_->strip());
  stripDock_->setWindowTitle(current_->strip()->windowTitle().isEmpty() ? current_->title()
                                                                        : current_->strip()->windowTitle());
  toolBar_->clear();
  delete tools_;
  tools_ = new QActionGroup(this);
  for (QAction* tool : current_->tools()) {
    if (tool->isCheckable()) tools_->addAction(tool);
    toolBar_->addAction(tool);
  }
  setShortcutsOn(tab, true);
  if (!tab.docks.isEmpty()) restoreState(tab.docks, kStateVersion);
  status_->clear();
  current_->activate();
  current_->canvas()->setFocus();
  updateWelcome();
}

QList<QAction*> MainWindow::allActions() const {
  QList<QAction*> found;
  const auto collect = [&found](const auto& self, const QList<QAction*>& actions) -> void {
    for (QAction* action : actions) {
      if (action->menu()) {
        self(self, action->menu()->actions());
      } else if (!action->isSeparator() && !action->text().isEmpty() && !found.contains(action)) {
        found << action;
      }
    }
  };
  collect(collect, menuBar()->actions());
  collect(collect, toolBar_->actions());
  return found;
}

bool MainWindow::isSettled() const { return context_.jobs.running().empty() && (!current_ || current_->isSettled()); }

void MainWindow::setScheme(Scheme scheme) {
  QSettings().setValue(kScheme, scheme == Scheme::Light);
  applyLook(*qobject_cast<QApplication*>(QCoreApplication::instance()), scheme);
}

void MainWindow::updateTitle() {
  setWindowTitle(tr("%1[*] – Windfall").arg(files_->name()));
  setWindowModified(context_.document.isModified());
  title_->setText(context_.document.isModified() ? files_->name() + QStringLiteral(" •") : files_->name());
  title_->setToolTip(context_.document.path());
}

void MainWindow::updateWelcome() {
  const model::Project& project = context_.document.project();
  const bool empty = project.leaves.empty() && project.plants.empty();
  if (empty) {
    QStringList names;
    const QStringList recent = recentFiles().mid(0, 6);
    for (const QString& path : recent) names << QFileInfo(path).completeBaseName();
    welcome_->setLinks(tr("Recent projects"), names, recent);
    canvases_->setCurrentWidget(welcome_);
  } else if (current_) {
    canvases_->setCurrentWidget(current_->canvas());
  }
}

void MainWindow::toggleDocks() {
  if (hidden_.empty()) {
    for (Dock* dock : {assetDock_, inspectorDock_, stripDock_}) {
      if (dock->isVisible()) hidden_.push_back(dock);
    }
    for (Dock* dock : hidden_) dock->hide();
  } else {
    for (Dock* dock : hidden_) dock->show();
    hidden_.clear();
  }
}

void MainWindow::showAsset(model::AssetId asset, AssetKind kind, bool switchWorkspace) {
  const QString id = QLatin1String(kWorkspaceOfKind[int(kind)]);
  if (switchWorkspace) openWorkspace(id);
  if (current_ && current_->id() == id) current_->show(asset);
}

void MainWindow::openDropped(const QString& path) {
  if (path.endsWith(QStringLiteral(".windfall"), Qt::CaseInsensitive)) return files_->openPath(path);
  for (std::size_t i = 0; i < tabs_.size(); ++i) {
    if (!tabs_[i].workspace->openFile(path)) continue;
    return switchTo(i);
  }
  messages_->showMessage(tr("%1: neither a picture, a tree nor a Windfall project").arg(QFileInfo(path).fileName()),
                         true);
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  event->acceptProposedAction();
  for (const QUrl& url : event->mimeData()->urls()) {
    if (url.isLocalFile()) openDropped(url.toLocalFile());
  }
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!files_->mayLeave()) return event->ignore();
  QSettings settings;
  settings.setValue(QStringLiteral("window/geometry"), saveGeometry());
  for (Tab& tab : tabs_) {
    if (tab.workspace == current_) tab.docks = saveState(kStateVersion);
    if (!tab.docks.isEmpty()) settings.setValue(QStringLiteral("window/docks/") + tab.workspace->id(), tab.docks);
  }
  if (current_) current_->deactivate();
  context_.jobs.cancelAll();
  event->accept();
}

void MainWindow::resetLayout() {
  for (Tab& tab : tabs_) tab.docks.clear();
  hidden_.clear();
  restoreState(defaultDocks_, kStateVersion);
}

void MainWindow::storeView() {
  for (const Tab& tab : tabs_) tab.workspace->beforeSave();
  model::ViewState view = context_.document.project().view;
  if (current_) view.workspace = current_->id();
  QJsonObject docks, views;
  for (Tab& tab : tabs_) {
    if (tab.workspace == current_) tab.docks = saveState(kStateVersion);
    if (!tab.docks.isEmpty()) docks[tab.workspace->id()] = QString::fromLatin1(tab.docks.toBase64());
    views[tab.workspace->id()] = tab.workspace->saveView();
  }
  view.layout[QStringLiteral("docks")] = docks;
  view.layout[QStringLiteral("views")] = views;
  context_.document.setView(view);
}

void MainWindow::restoreView() {
  const model::ViewState& view = context_.document.project().view;
  const QJsonObject docks = view.layout[QStringLiteral("docks")].toObject();
  const QJsonObject views = view.layout[QStringLiteral("views")].toObject();
  for (Tab& tab : tabs_) {
    const QByteArray saved = QByteArray::fromBase64(docks[tab.workspace->id()].toString().toLatin1());
    if (!saved.isEmpty()) tab.docks = saved;
    tab.workspace->restoreView(views[tab.workspace->id()].toObject());
    if (tab.workspace == current_ && !saved.isEmpty()) restoreState(saved, kStateVersion);
  }
  const model::Project& project = context_.document.project();
  if (!project.leaves.empty() || !project.plants.empty()) openWorkspace(view.workspace);
}

}  // namespace windfall::widgets
