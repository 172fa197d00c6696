// The one window: workspaces as tabs, the same four places in each.
#pragma once

#include <QJsonObject>
#include <QMainWindow>
#include <map>

#include "widgets/look/look.h"
#include "widgets/workspace.h"

class QActionGroup;
class QLabel;
class QPushButton;
class QStackedWidget;
class QToolBar;
class QToolButton;

namespace windfall::widgets {

class AssetTree;
class CommandPalette;
class Dock;
class EmptyState;
class MessageBar;
class ProjectFiles;
class ShortcutTable;
enum class AssetKind;

class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  explicit MainWindow(WorkspaceContext context, QWidget* parent = nullptr);
  ~MainWindow() override;

  /// In the order of the tabs; the window owns it from now on. Call `start` after the last one.
  void addWorkspace(Workspace* workspace);
  /// Restores geometry and layout and opens the first workspace.
  void start();
  /// By id; unknown ids change nothing.
  void openWorkspace(const QString& id);
  Workspace* workspace(const QString& id) const;
  Workspace* current() const { return current_; }

  ProjectFiles& files() { return *files_; }
  AssetTree& assets() { return *assets_; }
  MessageBar& messages() { return *messages_; }
  CommandPalette& commands() { return *commandPalette_; }
  /// Every action that a menu or the tool bar offers now.
  QList<QAction*> allActions() const;
  /// Nothing runs and the shown workspace has drawn itself.
  bool isSettled() const;
  /// Switches the whole program's look and remembers it.
  void setScheme(Scheme scheme);

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  struct Tab {
    Workspace* workspace;
    QToolButton* button;
    QMenu* menu;
    QAction* action;
    QByteArray docks;  ///< layout when it was left
  };

  void buildTopBar();
  void buildDocks();
  void buildMenus();
  void buildStatusBar();
  void fillRecent(QMenu& menu);
  void switchTo(std::size_t index);
  /// All that the menu and its submenus offer.
  static QList<QAction*> actionsOf(const QMenu& menu);
  void setShortcutsOn(const Tab& tab, bool on);
  /// After the workspaces stand: the artist's keys for what works everywhere.
  void registerShortcuts();
  void editShortcuts();
  void updateTitle();
  void updateWelcome();
  void toggleDocks();
  void showAsset(model::AssetId asset, AssetKind kind, bool switchWorkspace);
  void openDropped(const QString& path);
  void resetLayout();
  /// Layout and views into the document, and back.
  void storeView();
  void restoreView();

  WorkspaceContext context_;
  std::vector<Tab> tabs_;
  Workspace* current_ = nullptr;
  ProjectFiles* files_;
  AssetTree* assets_ = nullptr;
  MessageBar* messages_ = nullptr;
  CommandPalette* commandPalette_ = nullptr;
  ShortcutTable* shortcuts_ = nullptr;
  EmptyState* welcome_ = nullptr;
  QStackedWidget *canvases_ = nullptr, *inspectors_ = nullptr, *strips_ = nullptr;
  QWidget* topBar_ = nullptr;
  QWidget *tabRow_ = nullptr, *cornerRow_ = nullptr;
  QToolBar* toolBar_ = nullptr;
  QActionGroup* tools_ = nullptr;
  Dock *assetDock_ = nullptr, *inspectorDock_ = nullptr, *stripDock_ = nullptr;
  QLabel *title_ = nullptr, *status_ = nullptr;
  QMenu *viewMenu_ = nullptr, *windowMenu_ = nullptr;
  QAction *firstAfterWorkspaces_ = nullptr, *sampleAction_ = nullptr;
  QPushButton* sampleButton_ = nullptr;
  std::vector<Dock*> hidden_;  ///< by Tab
  QByteArray defaultDocks_;
};

}  // namespace windfall::widgets
