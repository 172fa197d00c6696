#include "widgets/main_window/project_files.h"

#include <QDir>
#include <QEventLoop>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QSettings>

#include "model/document/project_file.h"
#include "widgets/main_window/recent_files.h"

namespace windfall::widgets {

namespace {
const QString kFolder = QStringLiteral("projectFolder");
const QString kEnding = QStringLiteral(".windfall");
}  // namespace

ProjectFiles::ProjectFiles(model::Document& document, model::JobRunner& jobs, QWidget* window)
    : QObject(window), document_(document), jobs_(jobs), window_(window) {}

QString ProjectFiles::name() const {
  return document_.path().isEmpty() ? tr("Untitled") : QFileInfo(document_.path()).completeBaseName();
}

void ProjectFiles::newProject() {
  if (!mayLeave()) return;
  jobs_.cancelAll();
  document_.open({}, {});
}

void ProjectFiles::open() {
  const QString path = QFileDialog::getOpenFileName(window_, tr("Open Project"), QSettings().value(kFolder).toString(),
                                                    tr("Windfall projects (*%1)").arg(kEnding));
  if (!path.isEmpty()) openPath(path);
}

void ProjectFiles::openPath(const QString& path) {
  if (!mayLeave()) return;
  jobs_.cancelAll();
  jobs_.start<model::Project>(
      tr("Opening %1").arg(QFileInfo(path).fileName()), QStringLiteral("open"),
      [path](model::Progress& progress) { return model::readProject(path, progress); },
      [this, path](model::Project project) {
        document_.open(std::move(project), path);
        addRecentFile(path);
        QSettings().setValue(kFolder, QFileInfo(path).absolutePath());
      });
}

void ProjectFiles::openSample() {
  if (!makeSample_ || !mayLeave()) return;
  jobs_.cancelAll();
  jobs_.start<model::Project>(tr("Making the sample"), QStringLiteral("open"), makeSample_,
                              [this](model::Project project) { document_.open(std::move(project), {}); });
}

void ProjectFiles::save() {
  if (document_.path().isEmpty()) return saveAs();
  startSaving(document_.path());
}

void ProjectFiles::saveAs() {
  if (const QString path = askForPath(); !path.isEmpty()) startSaving(path);
}

QString ProjectFiles::askForPath() {
  const QString folder = QSettings().value(kFolder).toString();
  const QString proposal = document_.path().isEmpty() ? QDir(folder).filePath(name() + kEnding) : document_.path();
  QString path =
      QFileDialog::getSaveFileName(window_, tr("Save Project"), proposal, tr("Windfall projects (*%1)").arg(kEnding));
  if (!path.isEmpty() && QFileInfo(path).suffix().isEmpty()) path += kEnding;
  return path;
}

void ProjectFiles::startSaving(const QString& path) {
  // One after the other: two writers of one file could end in the wrong order.
  finishSaving();
  emit aboutToSave();
  const QString file = QFileInfo(path).fileName();
  saving_ = jobs_.start<bool>(
      tr("Saving %1").arg(file), QString(),
      [project = document_.project(), path, file](model::Progress& progress) -> Result<bool> {
        if (Status written = model::writeProject(project, path, progress); !written) return written.error();
        return true;
      },
      [this, path, file, revision = document_.revision()](bool) {
        document_.markSaved(path, revision);
        addRecentFile(path);
        QSettings().setValue(kFolder, QFileInfo(path).absolutePath());
        emit message(tr("Saved %1").arg(file), false);
      });
}

bool ProjectFiles::saveTo(const QString& path) {
  startSaving(path);
  bool saved = false;
  const auto listen = connect(this, &ProjectFiles::message, this, [&](const QString&, bool error) { saved = !error; });
  finishSaving();
  disconnect(listen);
  return saved;
}

void ProjectFiles::finishSaving() {
  if (!saving_) return;
  QEventLoop loop;
  connect(saving_, &model::Job::finished, &loop, &QEventLoop::quit);
  loop.exec(QEventLoop::ExcludeUserInputEvents);
  saving_.clear();
}

bool ProjectFiles::mayLeave() {
  finishSaving();
  if (!document_.isModified()) return true;
  QMessageBox question(QMessageBox::NoIcon, tr("Windfall"), tr("Save the changes to “%1”?").arg(name()),
                       QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, window_);
  question.setInformativeText(tr("They are lost otherwise."));
  question.setDefaultButton(QMessageBox::Save);
  switch (question.exec()) {
    case QMessageBox::Save: {
      const QString path = document_.path().isEmpty() ? askForPath() : document_.path();
      return !path.isEmpty() && saveTo(path);
    }
    case QMessageBox::Discard:
      return true;
    default:
      return false;
  }
}

}  // namespace windfall::widgets
