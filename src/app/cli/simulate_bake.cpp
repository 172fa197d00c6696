#include "app/cli/simulate_bake.h"

#include <QFileInfo>
#include <algorithm>
#include <cstdio>

#include "app/cli/command.h"
#include "model/document/project_file.h"
#include "model/export/exporter.h"
#include "model/plant/bake.h"
#include "model/plant/import.h"

namespace windfall::app {

int bakeInto(model::Project project, const QString& path, const QString& target, double seconds,
             model::Progress& progress) {
  const QString suffix = QFileInfo(target).suffix().toLower();
  if (!QStringList{"glb", "gltf", "windfall"}.contains(suffix)) {
    return fail(target, QStringLiteral("is no format that keeps a clip (.glb, .gltf, .windfall)"));
  }
  if (!QFileInfo(QFileInfo(target).absolutePath()).isDir()) {
    return fail(target, QStringLiteral("its folder does not exist"));
  }
  model::Plant* plant = project.scene.trees.empty() ? nullptr : project.plant(project.scene.trees.front().plant);
  if (plant == nullptr) return fail(path, QStringLiteral("has no tree in its scene"));
  const Result<model::PlantGeometry> geometry = model::loadGeometry(*plant, progress);
  if (!geometry) return fail(path, geometry.error());
  model::BakeSettings settings;
  settings.length = seconds;
  settings.wind = project.scene.wind;
  settings.solver = project.scene.solver;
  const QString stem = QStringLiteral("Wind %1 m/s").arg(static_cast<double>(settings.wind.speed), 0, 'f', 1);
  settings.name = stem;
  const auto taken = [&](const QString& name) {
    const auto is = [&](const model::Clip& clip) { return clip.name == name; };
    return std::any_of(plant->clips.begin(), plant->clips.end(), is) ||
           std::any_of(geometry->clips.begin(), geometry->clips.end(), is);
  };
  for (int copy = 2; taken(settings.name); ++copy) settings.name = QStringLiteral("%1 %2").arg(stem).arg(copy);
  Result<model::Clip> clip = model::bakeClip(*geometry, model::buildBodies(*geometry, *plant), settings, progress);
  if (!clip) return fail(path, clip.error());
  const QByteArray told = QStringLiteral("%1: %2 s, %3 bones, %4 keys")
                              .arg(clip->name)
                              .arg(clip->length)
                              .arg(clip->tracks.size())
                              .arg(clip->keyCount())
                              .toUtf8();
  plant->clips.push_back(std::move(*clip));
  Status written = ok();
  if (suffix == QLatin1String("windfall")) {
    written = model::writeProject(project, target, progress);
  } else {
    written = model::findExporter("gltf")->write(project, plant->id, target, {}, progress);
  }
  if (!written) return fail(target, written.error());
  std::printf("%s\n", told.constData());
  return 0;
}

}  // namespace windfall::app
