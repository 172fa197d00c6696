#include "model/source_file.h"

#include <QFile>
#include <QFileInfo>

namespace windfall::model {

Result<SourceFile> readSourceFile(const QString& path) {
  constexpr qint64 kLargest = qint64{1} << 30;
  const QFileInfo info(path);
  if (info.isDir()) return Error{"is a folder"};
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return Error{"cannot be opened: " + file.errorString().toStdString()};
  if (file.size() > kLargest) return Error{"is larger than 1 GiB"};
  SourceFile source{info.fileName(), file.readAll()};
  if (file.error() != QFileDevice::NoError) return Error{"cannot be read: " + file.errorString().toStdString()};
  if (source.bytes.isEmpty()) return Error{"is empty"};
  return source;
}

}  // namespace windfall::model
