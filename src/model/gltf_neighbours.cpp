#include "model/gltf_neighbours.h"

#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QUrl>

namespace windfall::model {

namespace {

constexpr qint64 kLargest = qint64{1} << 30;  // of all together

/// Path of a file below the folder; empty: elsewhere.
QString pathBelow(const QString& uri, const QDir& folder) {
  const QString name = QDir::cleanPath(QUrl::fromPercentEncoding(uri.toUtf8()));
  if (uri.contains(QLatin1String("://")) || QDir::isAbsolutePath(name) || name.startsWith(QLatin1String(".."))) {
    return {};
  }
  return folder.filePath(name);
}

QString mimeOf(const QString& path) {
  const QString suffix = QFileInfo(path).suffix().toLower();
  if (suffix == QLatin1String("png")) return QStringLiteral("image/png");
  if (suffix == QLatin1String("jpg") || suffix == QLatin1String("jpeg")) return QStringLiteral("image/jpeg");
  return QStringLiteral("application/octet-stream");
}

}  // namespace

Result<QByteArray> takeInNeighbours(const QByteArray& gltf, const QDir& folder) {
  QJsonObject root = QJsonDocument::fromJson(gltf).object();
  qint64 total = gltf.size();
  bool changed = false;
  for (const char* kind : {"buffers", "images"}) {
    const QString key = QLatin1String(kind);
    QJsonArray list = root[key].toArray();
    for (QJsonValueRef item : list) {
      QJsonObject object = item.toObject();
      const QString uri = object["uri"].toString();
      if (uri.isEmpty() || uri.startsWith(QLatin1String("data:"))) continue;
      const QString path = pathBelow(uri, folder);
      if (path.isEmpty()) continue;
      QFile file(path);
      if (!file.open(QIODevice::ReadOnly)) {
        if (key == QLatin1String("images")) continue;
        return Error{"its buffer \"" + uri.left(80).toStdString() + "\" is not beside it"};
      }
      total += file.size();
      if (total > kLargest) return Error{"is larger than 1 GiB with the files that it names"};
      object["uri"] =
          QStringLiteral("data:%1;base64,").arg(mimeOf(path)) + QString::fromLatin1(file.readAll().toBase64());
      item = object;
      changed = true;
    }
    if (changed) root[key] = list;
  }
  return changed ? QJsonDocument(root).toJson(QJsonDocument::Compact) : gltf;
}

}  // namespace windfall::model
