#include "model/export/write_together.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QTemporaryDir>

namespace windfall::model {

namespace {

Error about(const QString& name, const QString& what) { return {(name + QStringLiteral(": ") + what).toStdString()}; }

}  // namespace

Status writeTogether(const QString& folder, const std::vector<NamedBytes>& files, const QStringList& stale) {
  const QDir place(folder);
  const bool isNew = !place.exists();
  if (!QDir().mkpath(folder)) return Error{"the folder cannot be made"};
  const auto undoFolder = [&] {
    if (isNew) QDir().rmdir(folder);
  };
  QTemporaryDir making(place.filePath(QStringLiteral(".windfall-XXXXXX")));
  if (!making.isValid()) {
    undoFolder();
    return Error{"the folder cannot be written: " + making.errorString().toStdString()};
  }
  const auto fails = [&](const Error& error) {
    making.remove();
    undoFolder();
    return error;
  };
  for (const NamedBytes& file : files) {
    if (QFileInfo(place.filePath(file.name)).isDir()) return fails(about(file.name, QStringLiteral("is a folder")));
    QFile made(making.filePath(file.name));
    if (!made.open(QIODevice::WriteOnly) || made.write(file.bytes) != file.bytes.size() || !made.flush()) {
      return fails(about(file.name, made.errorString()));
    }
  }
  for (const NamedBytes& file : files) {
    const QString to = place.filePath(file.name);
    if (QFile::exists(to) && !QFile::remove(to)) {
      return fails(about(file.name, QStringLiteral("it cannot be replaced")));
    }
    if (!QFile::rename(making.filePath(file.name), to)) {
      return fails(about(file.name, QStringLiteral("it cannot be put in place")));
    }
  }
  for (const QString& name : stale) QFile::remove(place.filePath(name));
  return ok();
}

}  // namespace windfall::model
