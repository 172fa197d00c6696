// Recovery files: what was not saved when the program or the machine went down.
#pragma once

#include <QLockFile>
#include <QObject>
#include <QString>
#include <QTimer>
#include <memory>
#include <vector>

#include "model/document/document.h"
#include "model/document/job.h"

namespace windfall::model {

/// What a session that ended without saying goodbye left behind.
struct Recovery {
  QString file;      ///< the recovery file, a project file like any other
  QString original;  ///< the user's file; empty: it was never saved
};

/// Where recovery files stand: a folder of the application's data, never beside the user's file.
QString recoveryFolder();

/// Files of dead sessions that hold work their user's file does not: it is gone, or older and different. Never deletes.
std::vector<Recovery> findRecoveries(const QString& folder = recoveryFolder());

/// Deletes a recovery file: only after the user has said so.
void discardRecovery(const Recovery& recovery);

/// Keeps the recovery file of one document while it is modified, under a lock that dies with the process.
class Autosave : public QObject {
  Q_OBJECT
 public:
  explicit Autosave(Document& document, const QString& folder = recoveryFolder(), QObject* parent = nullptr);
  /// A clean end: nothing of this session stays behind.
  ~Autosave() override;

  void setInterval(int seconds);
  /// Empty when the folder can't be written (then nothing is saved, and `failed` says so).
  QString file() const { return file_; }
  /// Writes in the background if there are edits since the last time.
  void saveNow();
  void waitForSave() { jobs_.waitForAll(); }

  /// Opens what a dead session left, as a modified project of its original path; its file becomes this session's. On
  /// error nothing changes.
  Status recover(const Recovery& recovery, Progress& progress);

 signals:
  void failed(const QString& message);

 private:
  void forget();
  Status describe(const QString& original);

  Document& document_;
  QString file_;
  std::unique_ptr<QLockFile> lock_;
  QTimer timer_;
  bool stale_ = false;  ///< edits that the recovery file doesn't have
  JobRunner jobs_;      ///< last: it ends before the rest goes
};

}  // namespace windfall::model
