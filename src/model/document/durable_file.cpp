#include "model/document/durable_file.h"

#include <QFile>
#include <QFileInfo>
#include <QSaveFile>

#ifdef Q_OS_UNIX
#include <fcntl.h>
#include <unistd.h>
#endif

namespace windfall::model {

namespace {

/// A rename lives in its folder: until that is on the disk, the old name may come back after a power cut.
void syncFolder([[maybe_unused]] const QString& folder) {
#ifdef Q_OS_UNIX
  const int handle = ::open(QFile::encodeName(folder).constData(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0) return;
  ::fsync(handle);
  ::close(handle);
#endif
}

}  // namespace

// Crash by crash:
// * while the new bytes are written: they go to a temporary name beside the target, the target is untouched;
//   what stays is a file NAME.XXXXXX that nothing reads.
// * after writing, before the rename: commit() syncs the temporary file first, so the name never stands for bytes that
//   are not on the disk yet (a rename may reach the disk before the data it points to).
// * in the rename: it is atomic within a folder; a reader sees the old file or the new one.
// * after the rename, before the folder is synced: a power cut may bring the old file back, whole.
// * disk full, no permission, a failed sync: commit() fails, the temporary file is removed, the target is untouched.
Status writeDurably(const QString& path, const QByteArray& bytes) {
  if (QFileInfo(path).isDir()) return Error{"is a folder"};
  QSaveFile file(path);
  const auto failure = [&file] { return Error{("cannot be written: " + file.errorString()).toStdString()}; };
  if (!file.open(QIODevice::WriteOnly)) return failure();
  if (file.write(bytes) != bytes.size() || !file.commit()) return failure();
  syncFolder(QFileInfo(QFileInfo(path).canonicalFilePath()).path());
  return ok();
}

}  // namespace windfall::model
