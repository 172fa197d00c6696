#include "model/export/write_together.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QTemporaryDir>

namespace windfall::model {

namespace {

Error about(const QString& name, const QString& what) { return {(name + QStringLiteral(": ") + what).toStdString()}; }

}  // namespace

Status writeBytes(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  if (!file.open(QIODevice::WriteOnly | QIODevice::Unbuffered)) return Error{file.errorString().toStdString()};
  // A disk that fills up takes a part first, and says why only when the rest is asked of it.
  for (qint64 done = 0; done < bytes.size();) {
    const qint64 taken = file.write(bytes.constData() + done, bytes.size() - done);
    if (taken <= 0) return Error{file.errorString().toStdString()};
    done += taken;
  }
  return ok();
}

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
    if (const Status written = writeBytes(making.filePath(file.name), file.bytes); !written) {
      return fails(about(file.name, QString::fromStdString(written.error().message)));
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
