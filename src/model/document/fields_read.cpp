#include <QBuffer>
#include <QImageReader>

#include "model/document/fields.h"

namespace windfall::model {

namespace {

constexpr qint64 kLargestSource = qint64(1) << 30, kLargestImage = qint64(256) << 20;
constexpr int kLongestSide = 16384;
constexpr qint64 kMostPixels = 64'000'000;
constexpr qsizetype kMostPoints = 1'000'000, kMostIds = 100'000;

QString typeName(QJsonValue::Type type) {
  switch (type) {
    case QJsonValue::Bool:
      return QStringLiteral("true or false");
    case QJsonValue::Double:
      return QStringLiteral("a number");
    case QJsonValue::String:
      return QStringLiteral("text");
    case QJsonValue::Array:
      return QStringLiteral("a list");
    default:
      return QStringLiteral("an object");
  }
}

}  // namespace

QString FieldReader::inside(const char* key) const {
  return place_.isEmpty() ? QString::fromLatin1(key) : place_ + '.' + QLatin1String(key);
}

void FieldReader::fail(const QString& place, const QString& message) {
  if (!failed()) context_->error = place + QStringLiteral(": ") + message;
}

QJsonValue FieldReader::get(const char* key, QJsonValue::Type type) {
  if (failed()) return QJsonValue::Undefined;
  QJsonValue value = object_.value(QLatin1String(key));
  if (value.isUndefined() || value.type() == type) return value;
  fail(inside(key), QStringLiteral("is not %1").arg(typeName(type)));
  return QJsonValue::Undefined;
}

std::optional<double> FieldReader::readNumber(const char* key, double low, double high, bool whole) {
  const QJsonValue json = get(key, QJsonValue::Double);
  if (json.isUndefined()) return {};
  const double value = json.toDouble();
  if (!(value >= low && value <= high)) {
    fail(inside(key), QStringLiteral("is %1, expected %2 to %3").arg(value).arg(low).arg(high));
    return {};
  }
  if (whole && value != std::floor(value)) {
    fail(inside(key), QStringLiteral("is %1, expected a whole number").arg(value));
    return {};
  }
  return value;
}

std::optional<quint64> FieldReader::readSeed(const char* key) {
  if (object_.value(QLatin1String(key)).isString()) {
    bool good = false;
    const quint64 value = get(key, QJsonValue::String).toString().toULongLong(&good);
    if (good) return value;
    fail(inside(key), QStringLiteral("is not a whole number"));
    return {};
  }
  const auto value = readNumber(key, 0, kExactInteger, true);
  return value ? std::optional(static_cast<quint64>(*value)) : std::nullopt;
}

void FieldReader::flag(const char* key, bool& value) {
  if (const QJsonValue json = get(key, QJsonValue::Bool); !json.isUndefined()) value = json.toBool();
}

void FieldReader::text(const char* key, QString& value, qsizetype most) {
  const QJsonValue json = get(key, QJsonValue::String);
  if (json.isUndefined()) return;
  value = json.toString();
  if (value.size() > most) {
    fail(inside(key), QStringLiteral("is longer than %1 characters").arg(most));
  }
}

void FieldReader::id(const char* key, AssetId& value) {
  if (!failed() && !object_.contains(QLatin1String(key))) return fail(inside(key), QStringLiteral("is missing"));
  if (const auto read = readNumber(key, 1, kExactInteger, true)) value.value = static_cast<quint64>(*read);
}

void FieldReader::ids(const char* key, std::vector<AssetId>& values) {
  const QJsonArray array = get(key, QJsonValue::Array).toArray();
  if (array.size() > kMostIds) return fail(inside(key), QStringLiteral("has more than %1 items").arg(kMostIds));
  for (qsizetype i = 0; i < array.size(); ++i) {
    const double value = array[i].toDouble(-1);
    if (!(value >= 1 && value <= kExactInteger && value == std::floor(value))) {
      return fail(QStringLiteral("%1[%2]").arg(inside(key)).arg(i), QStringLiteral("is not an id"));
    }
    values.push_back({static_cast<quint64>(value)});
  }
}

bool FieldReader::triple(const char* key, double (&xyz)[3], double limit) {
  const QJsonValue json = get(key, QJsonValue::Array);
  if (json.isUndefined()) return false;
  const QJsonArray array = json.toArray();
  bool good = array.size() == 3;
  for (int i = 0; good && i < 3; ++i) {
    xyz[i] = array[i].toDouble(std::nan(""));
    good = std::abs(xyz[i]) <= limit;
  }
  if (!good) fail(inside(key), QStringLiteral("is not three numbers from -%1 to %1").arg(limit));
  return good;
}

void FieldReader::point(const char* key, std::optional<QPointF>& value) {
  std::vector<QPointF> read;
  points(key, read);
  if (failed() || !object_.contains(QLatin1String(key))) return;
  if (read.size() != 1) return fail(inside(key), QStringLiteral("is not a point"));
  value = read.front();
}

void FieldReader::place(const char* key, QPointF& value) {
  std::optional<QPointF> read;
  point(key, read);
  if (read) value = *read;
}

void FieldReader::points(const char* key, std::vector<QPointF>& values) {
  const QJsonValue json = get(key, QJsonValue::Array);
  if (json.isUndefined()) return;
  const QJsonArray array = json.toArray();
  values.clear();
  if (array.size() % 2 != 0) return fail(inside(key), QStringLiteral("has an x without its y"));
  if (array.size() / 2 > kMostPoints) {
    return fail(inside(key), QStringLiteral("has more than %1 points").arg(kMostPoints));
  }
  values.reserve(static_cast<size_t>(array.size() / 2));
  for (qsizetype i = 0; i < array.size(); i += 2) {
    const double x = array[i].toDouble(std::nan("")), y = array[i + 1].toDouble(std::nan(""));
    if (!(std::abs(x) <= kFarthest && std::abs(y) <= kFarthest)) {
      return fail(QStringLiteral("%1[%2]").arg(inside(key)).arg(i / 2), QStringLiteral("is not a point"));
    }
    values.emplace_back(x, y);
  }
}

void FieldReader::json(const char* key, QJsonObject& value) {
  if (const QJsonValue json = get(key, QJsonValue::Object); !json.isUndefined()) value = json.toObject();
}

bool FieldReader::content(const char* key, const QString& entry, qint64 limit, QByteArray& bytes) {
  Result<QByteArray> read = context_->entry(entry, limit);
  if (!read) {
    context_->cancelled = context_->cancelled || read.error().cancelled;
    fail(inside(key), QString::fromStdString(read.error().message));
    return false;
  }
  bytes = std::move(*read);
  return true;
}

void FieldReader::source(const char* key, SourceFile& file, const QString&) {
  const QJsonValue json = get(key, QJsonValue::Object);
  if (json.isUndefined()) return;
  FieldReader child(*context_, json.toObject(), inside(key));
  child.text("name", file.name);
  if (file.name.contains('/') || file.name.contains('\\')) {
    return fail(child.inside("name"), QStringLiteral("is not a plain file name"));
  }
  child.bytes("file", file.bytes, {});
}

void FieldReader::bytes(const char* key, QByteArray& bytes, const QString&) {
  const QJsonValue json = get(key, QJsonValue::String);
  if (!json.isUndefined()) content(key, json.toString(), kLargestSource, bytes);
}

void FieldReader::image(const char* key, QImage& image, const QString&, QImage::Format format) {
  const QJsonValue json = get(key, QJsonValue::String);
  if (json.isUndefined()) return;
  QByteArray png;
  if (!content(key, json.toString(), kLargestImage, png)) return;
  QBuffer buffer(&png);
  buffer.open(QIODevice::ReadOnly);
  QImageReader reader(&buffer, "png");
  reader.setAutoDetectImageFormat(false);
  // The header alone, before memory is spent on what it promises.
  const QSize size = reader.size();
  if (!size.isValid() || size.isEmpty()) return fail(inside(key), QStringLiteral("is not a PNG picture"));
  if (size.width() > kLongestSide || size.height() > kLongestSide ||
      qint64(size.width()) * size.height() > kMostPixels) {
    return fail(inside(key), QStringLiteral("is too large: %1 × %2 px").arg(size.width()).arg(size.height()));
  }
  const QImage read = reader.read();
  if (read.isNull() || read.size() != size) return fail(inside(key), QStringLiteral("is a damaged PNG picture"));
  image = read.convertToFormat(format);
}

}  // namespace windfall::model
