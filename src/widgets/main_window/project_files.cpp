#include "widgets/main_window/project_files.h"

#include <QDir>
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

bool ProjectFiles::save() { return document_.path().isEmpty() ? saveAs() : saveTo(document_.path()); }

bool ProjectFiles::saveAs() {
  const QString folder = QSettings().value(kFolder).toString();
  const QString proposal = document_.path().isEmpty() ? QDir(folder).filePath(name() + kEnding) : document_.path();
  QString path =
      QFileDialog::getSaveFileName(window_, tr("Save Project"), proposal, tr("Windfall projects (*%1)").arg(kEnding));
  if (path.isEmpty()) return false;
  if (QFileInfo(path).suffix().isEmpty()) path += kEnding;
  return saveTo(path);
}

bool ProjectFiles::saveTo(const QString& path) {
  emit aboutToSave();
  model::Progress progress;
  const Status saved = document_.save(path, progress);
  if (!saved) {
    emit message(
        tr("%1 was not saved: %2").arg(QFileInfo(path).fileName(), QString::fromStdString(saved.error().message)),
        true);
    return false;
  }
  addRecentFile(path);
  QSettings().setValue(kFolder, QFileInfo(path).absolutePath());
  emit message(tr("Saved %1").arg(QFileInfo(path).fileName()), false);
  return true;
}

bool ProjectFiles::mayLeave() {
  if (!document_.isModified()) return true;
  QMessageBox question(QMessageBox::NoIcon, tr("Windfall"), tr("Save the changes to “%1”?").arg(name()),
                       QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, window_);
  question.setInformativeText(tr("They are lost otherwise."));
  question.setDefaultButton(QMessageBox::Save);
  switch (question.exec()) {
    case QMessageBox::Save:
      return save();
    case QMessageBox::Discard:
      return true;
    default:
      return false;
  }
}

}  // namespace windfall::widgets
