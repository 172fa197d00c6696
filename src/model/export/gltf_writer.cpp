#include "model/export/gltf_writer.h"

#include <QBuffer>
#include <QJsonDocument>
#include <QtEndian>
#include <algorithm>
#include <limits>
#include <map>

namespace windfall::model {

namespace {

constexpr int kByte = 5121, kShort = 5123, kInt = 5125, kFloat = 5126;

/// Host order is little-endian on every machine that Windfall is built for; glTF asks for it.
static_assert(Q_BYTE_ORDER == Q_LITTLE_ENDIAN);

template <class T>
QByteArray raw(const std::vector<T>& values) {
  return QByteArray(reinterpret_cast<const char*>(values.data()), static_cast<qsizetype>(values.size() * sizeof(T)));
}

QString typeOf(int components) {
  return components == 1 ? "SCALAR" : components == 16 ? "MAT4" : QStringLiteral("VEC%1").arg(components);
}

void pad(QByteArray& bytes, char with) {
  while (bytes.size() % 4 != 0) bytes.append(with);
}

}  // namespace

int GltfWriter::view(const QByteArray& data, int target) {
  pad(buffer_, '\0');
  QJsonObject view{{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", data.size()}};
  if (target != 0) view["target"] = target;
  buffer_ += data;
  return add("bufferViews", view);
}

int GltfWriter::accessor(int view, int componentType, int count, int components, bool normalized) {
  QJsonObject accessor{
      {"bufferView", view}, {"componentType", componentType}, {"count", count}, {"type", typeOf(components)}};
  if (normalized) accessor["normalized"] = true;
  return add("accessors", accessor);
}

int GltfWriter::floats(const std::vector<float>& values, int components, int target, bool bounds) {
  const int count = static_cast<int>(values.size()) / components;
  const int index = accessor(view(raw(values), target), kFloat, count, components, false);
  if (!bounds) return index;
  QJsonArray low, high;
  for (int k = 0; k < components; ++k) {
    float least = std::numeric_limits<float>::max(), most = -least;
    for (auto i = static_cast<std::size_t>(k); i < values.size(); i += static_cast<std::size_t>(components)) {
      least = std::min(least, values[i]), most = std::max(most, values[i]);
    }
    low.append(static_cast<double>(least)), high.append(static_cast<double>(most));
  }
  at("accessors", index)["min"] = low;
  at("accessors", index)["max"] = high;
  return index;
}

int GltfWriter::bytes(const std::vector<std::uint8_t>& values, int components, bool normalized) {
  return accessor(view(raw(values), 34962), kByte, static_cast<int>(values.size()) / components, components,
                  normalized);
}

int GltfWriter::shorts(const std::vector<std::uint16_t>& values, int components) {
  return accessor(view(raw(values), 34962), kShort, static_cast<int>(values.size()) / components, components, false);
}

int GltfWriter::indices(const std::vector<std::uint32_t>& values) {
  return accessor(view(raw(values), 34963), kInt, static_cast<int>(values.size()), 1, false);
}

int GltfWriter::texture(const QImage& image, const QString& name) {
  QByteArray png;
  QBuffer out(&png);
  out.open(QIODevice::WriteOnly);
  image.save(&out, "png");
  const int picture = add("images", {{"name", name}, {"mimeType", "image/png"}, {"bufferView", view(png, 0)}});
  if (arrays_["samplers"].empty()) {
    add("samplers", {{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 10497}, {"wrapT", 10497}});
  }
  return add("textures", {{"source", picture}, {"sampler", 0}});
}

int GltfWriter::add(const QString& array, const QJsonObject& object) {
  arrays_[array].push_back(object);
  return static_cast<int>(arrays_[array].size()) - 1;
}

QJsonObject& GltfWriter::at(const QString& array, int index) { return arrays_[array][static_cast<std::size_t>(index)]; }

void GltfWriter::useExtension(const QString& name) {
  if (!extensions_.contains(name)) extensions_ << name;
}

QByteArray GltfWriter::json(const QString& scene, const QJsonArray& roots, const QString& bufferName) {
  QJsonObject document{{"asset", QJsonObject{{"version", "2.0"}, {"generator", "Windfall"}}},
                       {"scene", 0},
                       {"scenes", QJsonArray{QJsonObject{{"name", scene}, {"nodes", roots}}}}};
  QJsonObject buffer{{"byteLength", buffer_.size()}};
  if (!bufferName.isEmpty()) buffer["uri"] = bufferName;
  document["buffers"] = QJsonArray{buffer};
  for (const auto& [name, objects] : arrays_) {
    QJsonArray array;
    for (const QJsonObject& object : objects) array.append(object);
    if (!array.isEmpty()) document[name] = array;
  }
  if (!extensions_.isEmpty()) document["extensionsUsed"] = QJsonArray::fromStringList(extensions_);
  return QJsonDocument(document).toJson(bufferName.isEmpty() ? QJsonDocument::Compact : QJsonDocument::Indented);
}

QByteArray GltfWriter::binary(const QString& scene, const QJsonArray& roots) {
  pad(buffer_, '\0');
  QByteArray text = json(scene, roots, {});
  pad(text, ' ');
  QByteArray file("glTF", 4);
  const auto word = [&](qsizetype value) {
    const auto little = qToLittleEndian(static_cast<std::uint32_t>(value));
    file.append(reinterpret_cast<const char*>(&little), 4);
  };
  word(2);
  word(12 + 8 + text.size() + 8 + buffer_.size());
  word(text.size());
  file.append("JSON", 4);
  file += text;
  word(buffer_.size());
  file.append("BIN\0", 4);
  return file + buffer_;
}

QByteArray GltfWriter::text(const QString& scene, const QJsonArray& roots, const QString& bufferName,
                            QByteArray& buffer) {
  pad(buffer_, '\0');
  buffer = buffer_;
  return json(scene, roots, bufferName);
}

}  // namespace windfall::model
