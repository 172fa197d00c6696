// Values to JSON and back: one description of a struct's fields (project_fields.h) serves the writer and the reader.
#pragma once

#include <QImage>
#include <QJsonArray>
#include <QJsonObject>
#include <QPointF>
#include <QString>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <type_traits>
#include <vector>

#include "model/document/archive.h"
#include "model/ids.h"
#include "model/source_file.h"

namespace windfall::model {

/// Largest whole number that JSON's doubles keep exactly.
inline constexpr double kExactInteger = 9007199254740992.0;
/// Coordinates in px or m, of any picture or scene that makes sense.
inline constexpr double kFarthest = 1e6;
inline constexpr qsizetype kLongestText = 4096;

/// What one writing shares: the files beside project.json, and the first error ("leaves[0].bladeLength: …").
struct WriteContext {
  std::vector<ArchiveEntry> entries;
  QString error;
};

/// What one reading shares.
struct ReadContext {
  /// The content of an entry, at most `limit` bytes.
  std::function<Result<QByteArray>(const QString& name, qint64 limit)> entry;
  QString error;
  bool cancelled = false;
};

class FieldWriter {
 public:
  template <class T>
  using Ref = const T&;

  FieldWriter(WriteContext& context, QString place) : context_(&context), place_(std::move(place)) {}
  QJsonObject take() { return std::move(object_); }

  template <class T>
  void number(const char* key, const T& value, double low, double high) {
    checkRange(key, static_cast<double>(value), low, high);
    if constexpr (std::is_integral_v<T>) {
      object_[QLatin1String(key)] = static_cast<qint64>(value);
    } else {
      object_[QLatin1String(key)] = static_cast<double>(value);
    }
  }
  /// Any 64 bits: a number while JSON keeps it exactly, else decimal digits as text.
  void seed(const char* key, quint64 value);
  void flag(const char* key, bool value) { object_[QLatin1String(key)] = value; }
  void text(const char* key, const QString& value, qsizetype most = kLongestText);
  void id(const char* key, AssetId value) { seed(key, value.value); }
  void ids(const char* key, const std::vector<AssetId>& values);
  /// Three components, each within +-limit.
  template <class V>
  void vector(const char* key, const V& v, double limit = kFarthest) {
    triple(key, static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]), limit);
  }
  void point(const char* key, const std::optional<QPointF>& value);
  void points(const char* key, const std::vector<QPointF>& values);
  void place(const char* key, QPointF value) { points(key, {value}); }
  void json(const char* key, const QJsonObject& value) { object_[QLatin1String(key)] = value; }
  /// Into `stem` + the file's own suffix.
  void source(const char* key, const SourceFile& file, const QString& stem);
  /// As PNG in this format (Grayscale8 or RGBA8888).
  void image(const char* key, const QImage& image, const QString& entry, QImage::Format format);
  void bytes(const char* key, const QByteArray& bytes, const QString& entry);

  template <class T>
  void object(const char* key, const T& value) {
    FieldWriter child(*context_, inside(key));
    fields(child, value);
    object_[QLatin1String(key)] = child.take();
  }
  template <class T>
  void object(const char* key, const std::optional<T>& value) {
    if (value) object(key, *value);
  }
  /// `entryOf(index)`, where given, names the file of an item and is handed to its fields.
  template <class T, class... EntryOf>
  void list(const char* key, const std::vector<T>& values, qsizetype most, const EntryOf&... entryOf) {
    if (qsizetype(values.size()) > most) fail(inside(key), QStringLiteral("has more than %1 items").arg(most));
    QJsonArray array;
    for (size_t i = 0; i < values.size(); ++i) {
      FieldWriter child(*context_, QStringLiteral("%1[%2]").arg(inside(key)).arg(i));
      fields(child, values[i], entryOf(i)...);
      array.append(child.take());
    }
    object_[QLatin1String(key)] = array;
  }
  template <class T>
  void table(const char* key, const std::map<QString, T>& values, qsizetype) {
    QJsonObject rows;
    for (const auto& [name, value] : values) {
      FieldWriter child(*context_, QStringLiteral("%1[%2]").arg(inside(key), name));
      fields(child, value);
      rows[name] = child.take();
    }
    object_[QLatin1String(key)] = rows;
  }
  void fail(const QString& place, const QString& message);
  QString inside(const char* key) const;

 private:
  void checkRange(const char* key, double value, double low, double high);
  void triple(const char* key, double x, double y, double z, double limit);

  WriteContext* context_;
  QString place_;
  QJsonObject object_;
};

/// Absent fields keep their defaults; anything else that is not as described is the context's first error, after which
/// nothing more is read.
class FieldReader {
 public:
  template <class T>
  using Ref = T&;

  FieldReader(ReadContext& context, QJsonObject object, QString place)
      : context_(&context), object_(std::move(object)), place_(std::move(place)) {}
  bool failed() const { return !context_->error.isEmpty() || context_->cancelled; }

  template <class T>
  void number(const char* key, T& value, double low, double high) {
    if (const auto read = readNumber(key, low, high, std::is_integral_v<T>)) value = static_cast<T>(*read);
  }
  template <class T>
  void seed(const char* key, T& value) {
    static_assert(sizeof(T) == 8 && std::is_unsigned_v<T>, "quint64 and std::uint64_t are different types here");
    if (const auto read = readSeed(key)) value = *read;
  }
  void flag(const char* key, bool& value);
  void text(const char* key, QString& value, qsizetype most = kLongestText);
  /// Required, and not 0.
  void id(const char* key, AssetId& value);
  void ids(const char* key, std::vector<AssetId>& values);
  template <class V>
  void vector(const char* key, V& v, double limit = kFarthest) {
    double xyz[3];
    if (!triple(key, xyz, limit)) return;
    for (int i = 0; i < 3; ++i) v[i] = static_cast<float>(xyz[i]);
  }
  void point(const char* key, std::optional<QPointF>& value);
  void place(const char* key, QPointF& value);
  void points(const char* key, std::vector<QPointF>& values);
  void json(const char* key, QJsonObject& value);
  void source(const char* key, SourceFile& file, const QString& stem);
  void image(const char* key, QImage& image, const QString& entry, QImage::Format format);
  void bytes(const char* key, QByteArray& bytes, const QString& entry);

  template <class T>
  void object(const char* key, T& value) {
    const QJsonValue json = get(key, QJsonValue::Object);
    if (json.isUndefined()) return;
    FieldReader child(*context_, json.toObject(), inside(key));
    fields(child, value);
  }
  template <class T>
  void object(const char* key, std::optional<T>& value) {
    if (!object_.contains(QLatin1String(key))) return;
    value.emplace();
    object(key, *value);
  }
  template <class T, class... EntryOf>
  void list(const char* key, std::vector<T>& values, qsizetype most, const EntryOf&... entryOf) {
    const QJsonValue json = get(key, QJsonValue::Array);
    if (json.isUndefined()) return;
    const QJsonArray array = json.toArray();
    if (array.size() > most) return fail(inside(key), QStringLiteral("has more than %1 items").arg(most));
    values.clear();
    for (qsizetype i = 0; i < array.size() && !failed(); ++i) {
      const QString place = QStringLiteral("%1[%2]").arg(inside(key)).arg(i);
      if (!array[i].isObject()) return fail(place, QStringLiteral("is not an object"));
      FieldReader child(*context_, array[i].toObject(), place);
      fields(child, values.emplace_back(), entryOf(static_cast<size_t>(i))...);
    }
  }
  template <class T>
  void table(const char* key, std::map<QString, T>& values, qsizetype most) {
    const QJsonObject rows = get(key, QJsonValue::Object).toObject();
    if (rows.size() > most) return fail(inside(key), QStringLiteral("has more than %1 items").arg(most));
    for (auto row = rows.begin(); row != rows.end() && !failed(); ++row) {
      const QString place = QStringLiteral("%1[%2]").arg(inside(key), row.key().left(60));
      if (!row.value().isObject()) return fail(place, QStringLiteral("is not an object"));
      FieldReader child(*context_, row.value().toObject(), place);
      fields(child, values[row.key()]);
    }
  }
  void fail(const QString& place, const QString& message);
  QString inside(const char* key) const;

 private:
  /// Undefined where it is absent, reading has failed, or the type is another (which is an error).
  QJsonValue get(const char* key, QJsonValue::Type type);
  std::optional<double> readNumber(const char* key, double low, double high, bool whole);
  std::optional<quint64> readSeed(const char* key);
  bool triple(const char* key, double (&xyz)[3], double limit);
  bool content(const char* key, const QString& entry, qint64 limit, QByteArray& bytes);

  ReadContext* context_;
  QJsonObject object_;
  QString place_;
};

}  // namespace windfall::model
