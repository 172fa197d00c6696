#include "model/source_file.h"

#include <QFile>
#include <QFileInfo>

#include "model/gltf_neighbours.h"

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
  if (info.suffix().compare(QLatin1String("gltf"), Qt::CaseInsensitive) == 0) {
    Result<QByteArray> whole = takeInNeighbours(source.bytes, info.dir());
    if (!whole) return whole.error();
    source.bytes = *std::move(whole);
  }
  return source;
}

}  // namespace windfall::model
