#include "model/document/autosave.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonDocument>
#include <QJsonObject>
#include <QStandardPaths>
#include <QUuid>

#include "model/document/durable_file.h"
#include "model/document/project_file.h"

namespace windfall::model {

namespace {

// A session S keeps S.windfall, S.json (whose work it is) and S.lock (held while the session lives).
constexpr int kDefaultSeconds = 60;
constexpr const char* kProject = ".windfall";
constexpr const char* kNotes = ".json";
constexpr const char* kLock = ".lock";

QString besides(const QString& file, const char* suffix) {
  return file.chopped(static_cast<qsizetype>(qstrlen(kProject))) + QLatin1String(suffix);
}

std::unique_ptr<QLockFile> lockOf(const QString& file) {
  auto lock = std::make_unique<QLockFile>(besides(file, kLock));
  // No time makes a lock stale, only the death of its process: an editor may stay open for weeks.
  lock->setStaleLockTime(0);
  return lock;
}

bool holdsMore(const Recovery& recovery) {
  const QFileInfo original(recovery.original), file(recovery.file);
  if (recovery.original.isEmpty() || !original.exists()) return true;
  if (original.lastModified() > file.lastModified()) return false;
  Progress progress;
  const Result<Project> saved = readProject(recovery.original, progress);
  Result<Project> kept = readProject(recovery.file, progress);
  // A file that can't be read is for the user to judge.
  if (!saved || !kept) return true;
  kept->view = saved->view;
  kept->simulation = saved->simulation;
  return !(*saved == *kept);
}

}  // namespace

QString recoveryFolder() {
  return QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + QStringLiteral("/recovery");
}

std::vector<Recovery> findRecoveries(const QString& folder) {
  std::vector<Recovery> found;
  const QDir directory(folder);
  for (const QString& name : directory.entryList({QStringLiteral("*.windfall")}, QDir::Files, QDir::Time)) {
    Recovery recovery{directory.absoluteFilePath(name), {}};
    // Whoever can take the lock knows that its session is gone.
    const std::unique_ptr<QLockFile> lock = lockOf(recovery.file);
    if (!lock->tryLock(0)) continue;
    QFile notes(besides(recovery.file, kNotes));
    if (notes.open(QIODevice::ReadOnly)) {
      recovery.original = QJsonDocument::fromJson(notes.readAll()).object()[QStringLiteral("original")].toString();
    }
    if (holdsMore(recovery)) found.push_back(recovery);
  }
  return found;
}

void discardRecovery(const Recovery& recovery) {
  QFile::remove(recovery.file);
  QFile::remove(besides(recovery.file, kNotes));
}

Autosave::Autosave(Document& document, const QString& folder, QObject* parent) : QObject(parent), document_(document) {
  QDir().mkpath(folder);
  const QString session = QUuid::createUuid().toString(QUuid::WithoutBraces);
  file_ = QDir(folder).absoluteFilePath(session + QLatin1String(kProject));
  lock_ = lockOf(file_);
  if (!lock_->tryLock(0)) {
    file_.clear();
    lock_.reset();
  }
  connect(&document_, &Document::changed, this, [this](const Change& change) {
    if (change.aspect == Aspect::View || change.aspect == Aspect::Simulation) return;
    stale_ = true;
    // Another project stands here now, and what became of the old one was decided.
    if (change.aspect == Aspect::Everything) forget();
  });
  connect(&document_, &Document::modifiedChanged, this, [this](bool modified) {
    if (!modified) forget();
  });
  connect(&jobs_, &JobRunner::failed, this, [this](const QString&, const QString& message) {
    stale_ = true;
    emit failed(message);
  });
  connect(&timer_, &QTimer::timeout, this, &Autosave::saveNow);
  setInterval(kDefaultSeconds);
}

Autosave::~Autosave() {
  jobs_.cancelAll();
  jobs_.waitForAll();
  forget();
}

void Autosave::setInterval(int seconds) { timer_.start(seconds * 1000); }

void Autosave::forget() {
  if (file_.isEmpty()) return;
  jobs_.cancelAll();
  discardRecovery({file_, {}});
}

Status Autosave::describe(const QString& original) {
  const QJsonObject notes{{QStringLiteral("original"), original}};
  return writeDurably(besides(file_, kNotes), QJsonDocument(notes).toJson());
}

void Autosave::saveNow() {
  if (file_.isEmpty()) {
    emit failed(QStringLiteral("recovery files cannot be written to %1").arg(recoveryFolder()));
    return;
  }
  // One at a time: a save in flight is followed by the next tick.
  if (!document_.isModified() || !stale_ || !jobs_.running().empty()) return;
  stale_ = false;
  if (const Status noted = describe(document_.path()); !noted) {
    emit failed(QString::fromStdString(noted.error().message));
    return;
  }
  auto snapshot = std::make_shared<const Project>(document_.project());
  Job* job = jobs_.start<std::monostate>(
      QStringLiteral("Autosave"), {},
      [snapshot, file = file_](Progress& progress) { return writeProject(*snapshot, file, progress); },
      [](std::monostate) {});
  // The document may have been saved, or another opened, while this one was written.
  connect(job, &Job::finished, this, [this, job] {
    if (!document_.isModified() || job->isCancelled()) discardRecovery({file_, {}});
  });
}

Status Autosave::recover(const Recovery& recovery, Progress& progress) {
  Result<Project> read = readProject(recovery.file, progress);
  if (!read) return read.error();
  document_.open(std::move(*read), recovery.original);
  document_.undoStack().resetClean();
  // By renaming, the work is on the disk all the time.
  if (file_.isEmpty()) return ok();
  if (const Status noted = describe(recovery.original); !noted) return ok();
  if (QFile::rename(recovery.file, file_)) {
    discardRecovery(recovery);
    stale_ = false;
  }
  return ok();
}

}  // namespace windfall::model
