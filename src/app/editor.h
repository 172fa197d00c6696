// The editor: one document, its jobs, the main window with its workspaces.
#pragma once

#include <QSize>
#include <QString>
#include <memory>

#include "model/document/document.h"
#include "model/document/job.h"
#include "sim/result.h"
#include "widgets/main_window/main_window.h"

namespace windfall::model {
class Autosave;
}

namespace windfall::app {

/// Needs a QApplication. The window is not shown yet.
class Editor {
 public:
  Editor();
  ~Editor();

  model::Document& document() { return document_; }
  model::JobRunner& jobs() { return *jobs_; }
  widgets::MainWindow& window() { return *window_; }
  /// Runs the event loop until everything shown is computed and drawn; false: it took longer than `seconds`.
  bool settle(double seconds);
  /// Keeps recovery files from now on, and offers those of sessions that crashed.
  void startAutosave();

 private:
  model::Document document_;
  std::unique_ptr<model::JobRunner> jobs_;
  std::unique_ptr<widgets::MainWindow> window_;
  std::unique_ptr<model::Autosave> autosave_;
};

/// A picture of the real window instead of a session.
struct Shot {
  QString file;
  QString workspace;
  QSize size{1600, 1000};
};

struct EditorOptions {
  QString project;
  bool verbose = false;
  Shot shot;  ///< without a file: a session
};

/// Creates the QApplication and runs until the window is closed; the process's exit status.
int runEditor(int& argc, char** argv, const EditorOptions& options);

}  // namespace windfall::app
