#include "model/document/project_file.h"

#include "model/document/archive.h"
#include "model/document/durable_file.h"
#include "model/document/project_json.h"

namespace windfall::model {

namespace {

constexpr qint64 kLargestJson = qint64(256) << 20;

}  // namespace

Result<Project> readProject(const QString& path, Progress& progress) {
  Result<ArchiveReader> opened = ArchiveReader::open(path);
  if (!opened) return opened.error();
  ArchiveReader& archive = *opened;
  if (!archive.contains(QLatin1String(kProjectEntry))) {
    return Error{"is not a Windfall project: project.json is missing in it"};
  }
  const Result<QByteArray> json = archive.read(QLatin1String(kProjectEntry), kLargestJson, progress);
  if (!json) return json.error();
  const auto entries = static_cast<double>(archive.names().size());
  double done = 1;
  return fromJson(*json, [&](const QString& name, qint64 limit) {
    progress.report(std::min(done++ / entries, 1.0));
    return archive.read(name, limit, progress);
  });
}

Status writeProject(const Project& project, const QString& path, Progress& progress) {
  Result<std::vector<ArchiveEntry>> entries = toEntries(project);
  if (!entries) return Error{"cannot be saved: " + entries.error().message};
  progress.report(0.5);
  const Result<QByteArray> bytes = packArchive(*entries, progress);
  if (!bytes) return bytes.error();
  progress.report(0.9);
  if (progress.cancelled()) return Error{"cancelled", true};
  return writeDurably(path, *bytes);
}

}  // namespace windfall::model
