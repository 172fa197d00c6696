// One tab of the main window: a canvas in the middle, tools, an inspector, a strip below.
#pragma once

#include <QAction>
#include <QJsonObject>
#include <QList>
#include <QObject>
#include <QString>
#include <memory>

#include "model/document/document.h"
#include "model/document/job.h"
#include "model/plant/geometry_cache.h"

class QMenu;

namespace windfall::widgets {

/// What every workspace works on. Messages go to the message area with a level; status text to its right end.
struct WorkspaceContext {
  model::Document& document;
  model::JobRunner& jobs;
  /// The plant and the scene workspace show the same plants: read or grown once.
  std::shared_ptr<model::GeometryCache> shapes = std::make_shared<model::GeometryCache>();
};

/// The widgets are created by the workspace, parented by the main window, and live as long as the workspace.
class Workspace : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;
  virtual QString id() const = 0;     ///< "leaf", "plant", "scene"
  virtual QString title() const = 0;  ///< translated
  virtual QWidget* canvas() = 0;
  virtual QWidget* inspector() = 0;
  virtual QWidget* strip() = 0;
  /// Tools of the left bar, in the order of the work; the checkable ones are exclusive.
  virtual QList<QAction*> tools() = 0;
  /// Fills the workspace's own menu.
  virtual void fillMenu(QMenu& menu) = 0;
  /// Stands at the right end of the top bar in every workspace (the scene's choice of device); null: nothing.
  virtual QWidget* corner() { return nullptr; }
  /// Takes a file that was dropped or chosen; false: not of its kind, and nothing happened.
  virtual bool openFile(const QString& path) {
    Q_UNUSED(path);
    return false;
  }
  /// The plus of its group in the asset list: asks for what to add.
  virtual void add() {}
  /// Ctrl+E: exports again to where it went last, or asks; with `elsewhere` asks always.
  virtual void exportResult(bool elsewhere) { Q_UNUSED(elsewhere); }
  /// Its tab was opened or left (then strokes are cancelled, playing pauses).
  virtual void activate() {}
  virtual void deactivate() {}
  /// Shows an asset (a double click in the asset list).
  virtual void show(model::AssetId) {}
  /// Zoom, splitters: saved with the project's layout.
  virtual QJsonObject saveView() const { return {}; }
  virtual void restoreView(const QJsonObject&) {}
  /// Nothing is being computed any more for what is shown (pictures for the docs, tests).
  virtual bool isSettled() const { return true; }
  /// The project is about to be written: what runs goes into the document as it stands.
  virtual void beforeSave() {}

 signals:
  void message(const QString& text, bool isError);
  void status(const QString& text);
};

}  // namespace windfall::widgets
