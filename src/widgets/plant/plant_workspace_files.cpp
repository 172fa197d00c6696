// Files of the plant workspace: import, export, another file for a plant, and a file that changed on disk.
#include <QFileDialog>
#include <QFileInfo>
#include <QPointer>

#include "model/export/exporter.h"
#include "model/plant/import.h"
#include "widgets/plant/plant_export_dialog.h"
#include "widgets/plant/plant_settings.h"
#include "widgets/plant/plant_workspace.h"

namespace windfall::widgets {
namespace {

/// Reads the file and imports it once, so that what is wrong with it is said before it is added.
Result<model::Plant> readPlant(const QString& path, model::Progress& progress) {
  Result<model::SourceFile> file = model::readSourceFile(path);
  if (!file) return file.error();
  model::Plant plant;
  plant.name = QFileInfo(path).completeBaseName();
  plant.file = std::move(*file);
  Result<model::PlantGeometry> geometry = model::loadGeometry(plant, progress);
  if (geometry) return plant;
  return geometry.error();
}

/// The exporter that writes a file of this name; null: none.
const model::Exporter* exporterOf(const QString& path) {
  for (const auto& exporter : model::exporters()) {
    const bool writes = exporter->extensions().contains(QFileInfo(path).suffix().toLower());
    if (exporter->subject() == model::ExportSubject::Plant && writes) return exporter.get();
  }
  return nullptr;
}

}  // namespace

void PlantWorkspace::askForFile() {
  const QString path = QFileDialog::getOpenFileName(viewport_, tr("Import Plant"), {},
                                                    tr("Plants (%1)").arg(model::plantFilePatterns().join(' ')));
  if (!path.isEmpty()) openFile(path);
}

bool PlantWorkspace::openFile(const QString& path) {
  const QString pattern = "*." + QFileInfo(path).suffix().toLower();
  if (!model::plantFilePatterns().contains(pattern)) return false;
  context_.jobs.start<model::Plant>(
      tr("Importing %1").arg(QFileInfo(path).fileName()), "import plant",
      [path](model::Progress& progress) { return readPlant(path, progress); },
      [self = QPointer<PlantWorkspace>(this), path](model::Plant plant) {
        if (self) self->addPlant(std::move(plant), path);
      });
  return true;
}

void PlantWorkspace::exportResult(bool elsewhere) {
  const model::Plant* plant = context_.document.project().plant(plant_);
  if (plant == nullptr) return;
  QString path = exports_.contains(plant_) ? exports_[plant_] : QString();
  if (!path.isEmpty() && !elsewhere) return exportTo(path);
  QStringList filters;
  for (const auto& exporter : model::exporters()) {
    if (exporter->subject() != model::ExportSubject::Plant) continue;
    filters << QStringLiteral("%1 (*.%2)").arg(exporter->title(), exporter->extensions().join(" *."));
  }
  const QString initial = path.isEmpty() ? plant->name + QStringLiteral(".glb") : path;
  path = QFileDialog::getSaveFileName(viewport_, tr("Export Plant"), initial, filters.join(QStringLiteral(";;")));
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += QStringLiteral(".glb");
  const model::Exporter* exporter = exporterOf(path);
  if (exporter == nullptr) {
    emit message(tr("%1 is no format that plants are written in").arg(QFileInfo(path).fileName()), true);
    return;
  }
  PlantExportDialog dialog(*exporter, exportValues_, viewport_);
  if (dialog.exec() != QDialog::Accepted) return;
  exportValues_ = dialog.values();
  exportTo(path);
}

void PlantWorkspace::exportTo(const QString& path) {
  const model::Exporter* exporter = exporterOf(path);
  if (exporter == nullptr) return;
  exports_[plant_] = path;
  // What one exporter asks for another may not know.
  QJsonObject values;
  for (const model::ExportParameter& parameter : exporter->parameters()) {
    if (exportValues_.contains(parameter.key)) values[parameter.key] = exportValues_.value(parameter.key);
  }
  context_.jobs.start<QString>(
      tr("Exporting %1").arg(QFileInfo(path).fileName()), "export plant",
      [exporter, path, values, id = plant_,
       project = context_.document.project()](model::Progress& progress) -> Result<QString> {
        if (const Status written = exporter->write(project, id, path, values, progress); !written) {
          return Error{QFileInfo(path).fileName().toStdString() + ": " + written.error().message,
                       written.error().cancelled};
        }
        return path;
      },
      [self = QPointer<PlantWorkspace>(this)](const QString& written) {
        if (self) emit self->message(tr("Exported to %1").arg(written), false);
      });
}

void PlantWorkspace::askForReplacement() {
  const QString path = QFileDialog::getOpenFileName(viewport_, tr("Point at Another File"), {},
                                                    tr("Plants (%1)").arg(model::plantFilePatterns().join(' ')));
  if (!path.isEmpty()) replaceFile(path);
}

void PlantWorkspace::replaceFile(const QString& path) {
  context_.jobs.start<model::Plant>(
      tr("Importing %1").arg(QFileInfo(path).fileName()), "import plant",
      [path](model::Progress& progress) { return readPlant(path, progress); },
      [self = QPointer<PlantWorkspace>(this), path, id = plant_](const model::Plant& plant) {
        if (!self || self->context_.document.project().plant(id) == nullptr) return;
        self->watchFile(id, path);
        self->context_.document.setPlant(id, &model::Plant::file, plant.file, model::Aspect::PlantSource,
                                         tr("Point a plant at %1").arg(plant.file.name));
        self->showSettings();
      });
}

void PlantWorkspace::watchFile(model::AssetId plant, const QString& path) {
  paths_[plant] = path;
  changedOnDisk_.erase(plant);
  watcher_.addPath(path);
}

void PlantWorkspace::fileChanged(const QString& path) {
  for (const auto& [plant, watched] : paths_) {
    if (watched != path) continue;
    changedOnDisk_.insert(plant);
    emit message(
        tr("%1 has changed on disk: “Load again” in the plant's settings takes it up").arg(QFileInfo(path).fileName()),
        false);
  }
  // Programs that replace a file take it away from the watcher.
  if (QFileInfo::exists(path)) watcher_.addPath(path);
  showSettings();
}

}  // namespace windfall::widgets
