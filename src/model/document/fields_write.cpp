#include <QBuffer>
#include <QFileInfo>
#include <QImageWriter>
#include <QRegularExpression>

#include "model/document/fields.h"

namespace windfall::model {

namespace {

/// Qt turns quality into zlib's level: (100 - quality) * 9 / 91; this is level 2, five times as fast as 6 for a tenth
/// more bytes.
constexpr int kPngQuality = 75;
constexpr int kDotsPerMetre = 2835;  // 72 dpi

QByteArray toPng(const QImage& image) {
  // Same pixels without text, and with one resolution for all: a QImage takes that of the screen it is made on.
  const QImage bare(image.constBits(), image.width(), image.height(), image.bytesPerLine(), image.format());
  QImage plain = bare;
  plain.setDotsPerMeterX(kDotsPerMetre);
  plain.setDotsPerMeterY(kDotsPerMetre);
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  QImageWriter writer(&buffer, "png");
  writer.setQuality(kPngQuality);
  return writer.write(plain) ? bytes : QByteArray();
}

/// Formats that are compressed by themselves.
bool isCompressed(const QString& suffix) {
  static const QStringList known{"jpg", "jpeg", "png", "webp", "gif", "heic", "zip", "gz"};
  return known.contains(suffix);
}

}  // namespace

QString FieldWriter::inside(const char* key) const {
  return place_.isEmpty() ? QString::fromLatin1(key) : place_ + '.' + QLatin1String(key);
}

void FieldWriter::fail(const QString& place, const QString& message) {
  if (context_->error.isEmpty()) context_->error = place + QStringLiteral(": ") + message;
}

void FieldWriter::checkRange(const char* key, double value, double low, double high) {
  if (value >= low && value <= high) return;
  fail(inside(key), QStringLiteral("is %1, expected %2 to %3").arg(value).arg(low).arg(high));
}

void FieldWriter::seed(const char* key, quint64 value) {
  if (value <= static_cast<quint64>(kExactInteger)) {
    object_[QLatin1String(key)] = static_cast<qint64>(value);
  } else {
    object_[QLatin1String(key)] = QString::number(value);
  }
}

void FieldWriter::text(const char* key, const QString& value, qsizetype most) {
  if (value.size() > most) {
    return fail(inside(key), QStringLiteral("is longer than %1 characters").arg(most));
  }
  object_[QLatin1String(key)] = value;
}

void FieldWriter::ids(const char* key, const std::vector<AssetId>& values) {
  QJsonArray array;
  for (const AssetId value : values) array.append(static_cast<qint64>(value.value));
  object_[QLatin1String(key)] = array;
}

void FieldWriter::triple(const char* key, double x, double y, double z, double limit) {
  for (const double value : {x, y, z}) checkRange(key, value, -limit, limit);
  object_[QLatin1String(key)] = QJsonArray{x, y, z};
}

void FieldWriter::point(const char* key, const std::optional<QPointF>& value) {
  if (!value) return;
  for (const double coordinate : {value->x(), value->y()}) checkRange(key, coordinate, -kFarthest, kFarthest);
  object_[QLatin1String(key)] = QJsonArray{value->x(), value->y()};
}

void FieldWriter::points(const char* key, const std::vector<QPointF>& values) {
  QJsonArray array;
  for (const QPointF& value : values) {
    for (const double coordinate : {value.x(), value.y()}) {
      checkRange(key, coordinate, -kFarthest, kFarthest);
      array.append(coordinate);
    }
  }
  object_[QLatin1String(key)] = array;
}

void FieldWriter::source(const char* key, const SourceFile& file, const QString& stem) {
  if (file.name.isEmpty() && file.isEmpty()) return;
  FieldWriter child(*context_, inside(key));
  child.text("name", file.name);
  if (!file.isEmpty()) {
    static const QRegularExpression plain(QStringLiteral("^[a-z0-9]{1,8}$"));
    QString suffix = QFileInfo(file.name).suffix().toLower();
    if (!plain.match(suffix).hasMatch()) suffix = QStringLiteral("bin");
    const QString entry = stem + '.' + suffix;
    child.object_[QStringLiteral("file")] = entry;
    context_->entries.push_back({entry, file.bytes, isCompressed(suffix)});
  }
  object_[QLatin1String(key)] = child.take();
}

void FieldWriter::image(const char* key, const QImage& image, const QString& entry, QImage::Format format) {
  if (image.isNull()) return;
  const QByteArray png = toPng(image.convertToFormat(format));
  if (png.isEmpty()) return fail(inside(key), QStringLiteral("cannot be written as PNG"));
  object_[QLatin1String(key)] = entry;
  context_->entries.push_back({entry, png, true});
}

void FieldWriter::bytes(const char* key, const QByteArray& bytes, const QString& entry) {
  if (bytes.isEmpty()) return;
  object_[QLatin1String(key)] = entry;
  context_->entries.push_back({entry, bytes, false});
}

}  // namespace windfall::model
