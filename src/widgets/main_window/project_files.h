// New, open, save: the project's way between the window and its file.
#pragma once

#include <QObject>
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
  bool save();
  bool saveAs();
  bool saveTo(const QString& path);
  /// Saves, discards or stays, as the artist decides; true: the project may be left.
  bool mayLeave();
  /// The file's name without folder and ending, or "Untitled".
  QString name() const;

 signals:
  void message(const QString& text, bool isError);
  /// Before the project is written: the window puts its layout in.
  void aboutToSave();

 private:
  model::Document& document_;
  model::JobRunner& jobs_;
  QWidget* window_;
  std::function<Result<model::Project>(model::Progress&)> makeSample_;
};

}  // namespace windfall::widgets
