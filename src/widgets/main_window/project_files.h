// New, open, save: the project's way between the window and its file.
#pragma once

#include <QObject>
#include <QPointer>
#include <functional>

#include "model/document/document.h"
#include "model/document/job.h"

class QWidget;

namespace windfall::widgets {

/// Asks where it must (file names, unsaved changes) with `window` as the dialogs' parent.
class ProjectFiles : public QObject {
  Q_OBJECT
 public:
  ProjectFiles(model::Document& document, model::JobRunner& jobs, QWidget* window);

  /// Makes the sample project; without one `openSample` does nothing.
  void setSampleMaker(std::function<Result<model::Project>(model::Progress&)> make) { makeSample_ = std::move(make); }
  bool hasSample() const { return bool(makeSample_); }

  void newProject();
  void open();
  /// Reads in the background; on error the message says why and nothing changes.
  void openPath(const QString& path);
  void openSample();
  /// Writes in the background; edits made meanwhile stay unsaved edits. Without a path it asks for one.
  void save();
  void saveAs();
  void startSaving(const QString& path);
  /// Waits for the file to be whole; false: it was not saved, and the message says why.
  bool saveTo(const QString& path);
  /// Saves, discards or stays, as the artist decides; true: the project may be left. A save that runs ends first.
  bool mayLeave();
  /// The file's name without folder and ending, or "Untitled".
  QString name() const;

 signals:
  void message(const QString& text, bool isError);
  /// Before the project is written: the window puts its layout in.
  void aboutToSave();

 private:
  /// The file that the artist chose, or nothing.
  QString askForPath();
  void finishSaving();

  model::Document& document_;
  model::JobRunner& jobs_;
  QWidget* window_;
  std::function<Result<model::Project>(model::Progress&)> makeSample_;
  QPointer<model::Job> saving_;
};

}  // namespace windfall::widgets
