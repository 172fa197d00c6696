#include "model/plant/gltf_check.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QtEndian>
#include <cmath>
#include <string>
#include <vector>

#include "model/plant/hierarchy.h"

namespace windfall::model {

namespace {

std::string text(const QString& value) { return value.left(80).toStdString(); }

/// A whole number within `0 <= value < limit`, or -1.
qint64 index(const QJsonValue& value, qint64 limit) {
  const double number = value.toDouble(-1);
  return number >= 0 && number < static_cast<double>(limit) && number == std::floor(number)
             ? static_cast<qint64>(number)
             : -1;
}
qint64 size(const QJsonValue& value, qint64 otherwise) {
  return value.isUndefined() ? otherwise : index(value, qint64{1} << 48);
}

class Checker {
 public:
  Checker(const QJsonObject& root, const QByteArray& binaryChunk) : root_(root), chunk_(binaryChunk) {}

  /// Levels of nodes.
  Result<int> run() {
    if (!root_["asset"].toObject()["version"].toString().startsWith('2')) return Error{"is not glTF 2.0"};
    for (const QJsonValue& extension : root_["extensionsRequired"].toArray()) {
      const QString name = extension.toString();
      if (name.contains("draco", Qt::CaseInsensitive) || name.contains("meshopt", Qt::CaseInsensitive)) {
        return Error{"is compressed with " + text(name) + "; save it without compression"};
      }
    }
    for (const auto step : {&Checker::buffers, &Checker::views, &Checker::accessors, &Checker::nodes, &Checker::skins,
                            &Checker::meshes, &Checker::joints}) {
      if (const Status status = (this->*step)(); !status) return status.error();
    }
    return levels_;
  }

 private:
  QJsonArray list(const char* name) const { return root_[QLatin1String(name)].toArray(); }

  static Error wrong(const char* what, qsizetype i, const char* why) {
    return Error{std::string(what) + " " + std::to_string(i) + " " + why};
  }

  Status buffers() {
    for (const QJsonValue& value : list("buffers")) {
      const auto i = static_cast<qsizetype>(buffers_.size());
      const QString uri = value["uri"].toString();
      const qint64 bytes = size(value["byteLength"], -1);
      QByteArray data = i == 0 ? chunk_ : QByteArray();
      if (uri.startsWith("data:")) {
        data = QByteArray::fromBase64(uri.mid(uri.indexOf(',') + 1).toLatin1());
      } else if (!uri.isEmpty()) {
        return Error{"buffer \"" + text(uri) +
                     "\" is outside the file; save the plant as .glb or with embedded buffers"};
      }
      if (bytes < 0 || bytes > data.size()) return wrong("buffer", i, "is shorter than it says: the file is cut off");
      buffers_.push_back(data.left(bytes));
    }
    return ok();
  }

  Status views() {
    for (const QJsonValue& value : list("bufferViews")) {
      const auto i = static_cast<qsizetype>(viewData_.size());
      const qint64 buffer = index(value["buffer"], static_cast<qint64>(buffers_.size()));
      const qint64 offset = size(value["byteOffset"], 0), bytes = size(value["byteLength"], -1);
      if (buffer < 0 || offset < 0 || bytes < 0 || offset + bytes > buffers_[static_cast<std::size_t>(buffer)].size()) {
        return wrong("buffer view", i, "reaches outside its buffer");
      }
      viewData_.push_back(buffers_[static_cast<std::size_t>(buffer)].mid(offset, bytes));
      viewStrides_.push_back(size(value["byteStride"], 0));
    }
    return ok();
  }

  static qint64 elementSize(const QJsonValue& accessor) {
    const int component = accessor["componentType"].toInt();
    const qint64 bytes = component == 5120 || component == 5121   ? 1
                         : component == 5122 || component == 5123 ? 2
                         : component == 5125 || component == 5126 ? 4
                                                                  : 0;
    const QString type = accessor["type"].toString();
    const qint64 parts = type == "SCALAR"                   ? 1
                         : type == "VEC2"                   ? 2
                         : type == "VEC3"                   ? 3
                         : type == "VEC4" || type == "MAT2" ? 4
                         : type == "MAT3"                   ? 9
                         : type == "MAT4"                   ? 16
                                                            : 0;
    return bytes * parts;
  }

  Status accessors() {
    for (const QJsonValue& value : list("accessors")) {
      const auto i = static_cast<qsizetype>(accessorCounts_.size());
      const qint64 count = size(value["count"], -1), element = elementSize(value);
      if (count < 1 || element == 0) return wrong("accessor", i, "has no sound type and count");
      accessorCounts_.push_back(count);
      if (value["bufferView"].isUndefined()) return wrong("accessor", i, "has no data");
      const qint64 view = index(value["bufferView"], static_cast<qint64>(viewData_.size()));
      const qint64 offset = size(value["byteOffset"], 0);
      if (view < 0 || offset < 0) return wrong("accessor", i, "names a buffer view that is not there");
      const qint64 stride = std::max(viewStrides_[static_cast<std::size_t>(view)], element);
      const qint64 room = viewData_[static_cast<std::size_t>(view)].size() - offset - element;
      if (room < 0 || count - 1 > room / stride) return wrong("accessor", i, "reaches outside its buffer view");
    }
    return ok();
  }

  Status nodes() {
    const QJsonArray nodes = list("nodes");
    nodeCount_ = nodes.size();
    std::vector<std::ptrdiff_t> parent(static_cast<std::size_t>(nodeCount_), -1);
    for (qsizetype i = 0; i < nodeCount_; ++i) {
      for (const QJsonValue& value : nodes[i]["children"].toArray()) {
        const qint64 child = index(value, nodeCount_);
        if (child < 0) return wrong("node", i, "names a child that is not there");
        if (parent[static_cast<std::size_t>(child)] >= 0) return wrong("node", child, "has two parents");
        parent[static_cast<std::size_t>(child)] = i;
      }
    }
    const Result<int> levels = levelsOf(parent, [](std::size_t i) { return "node " + std::to_string(i); });
    if (!levels) return levels.error();
    levels_ = *levels;
    return ok();
  }

  /// Largest number in an accessor of unsigned whole numbers that has been checked; -1 for other accessors.
  qint64 largest(const QJsonValue& value) const {
    const QJsonObject accessor = list("accessors")[value.toInt()].toObject();
    const qint64 element = elementSize(accessor);
    const int component = accessor["componentType"].toInt();
    const int bytes = component == 5121 ? 1 : component == 5123 ? 2 : component == 5125 ? 4 : 0;
    if (bytes == 0) return -1;
    const auto view = static_cast<std::size_t>(accessor["bufferView"].toInt());
    const qint64 stride = std::max(viewStrides_[view], element), count = accessor["count"].toInteger();
    const char* at = viewData_[view].constData() + accessor["byteOffset"].toInteger();
    qint64 result = 0;
    for (qint64 i = 0; i < count; ++i, at += stride) {
      for (qint64 k = 0; k < element; k += bytes) {
        const qint64 number = bytes == 1   ? static_cast<uchar>(at[k])
                              : bytes == 2 ? qint64{qFromLittleEndian<quint16>(at + k)}
                                           : qint64{qFromLittleEndian<quint32>(at + k)};
        result = std::max(result, number);
      }
    }
    return result;
  }

  bool accessor(const QJsonValue& value, qint64 least = 0) const {
    const qint64 i = index(value, static_cast<qint64>(accessorCounts_.size()));
    return i >= 0 && accessorCounts_[static_cast<std::size_t>(i)] >= least;
  }

  Status skins() {
    const QJsonArray skins = list("skins");
    for (qsizetype i = 0; i < skins.size(); ++i) {
      const QJsonArray joints = skins[i]["joints"].toArray();
      for (const QJsonValue& joint : joints) {
        if (index(joint, nodeCount_) < 0) return wrong("skin", i, "names a joint that is not there");
      }
      const QJsonValue matrices = skins[i]["inverseBindMatrices"];
      // Assimp does not know that they may be left out.
      if (!accessor(matrices, joints.size())) return wrong("skin", i, "has fewer bind matrices than joints");
    }
    for (const QJsonValue& node : list("nodes")) {
      const QJsonValue skin = node["skin"], mesh = node["mesh"];
      if (!skin.isUndefined() && index(skin, skins.size()) < 0) return Error{"a node names a skin that is not there"};
      if (!mesh.isUndefined() && index(mesh, list("meshes").size()) < 0) {
        return Error{"a node names a mesh that is not there"};
      }
    }
    return ok();
  }

  Status meshes() {
    const QJsonArray meshes = list("meshes");
    for (qsizetype i = 0; i < meshes.size(); ++i) {
      for (const QJsonValue& primitive : meshes[i]["primitives"].toArray()) {
        const QJsonObject attributes = primitive["attributes"].toObject();
        const qint64 position = index(attributes["POSITION"], static_cast<qint64>(accessorCounts_.size()));
        const qint64 vertices = position < 0 ? 0 : accessorCounts_[static_cast<std::size_t>(position)];
        for (const QJsonValue& attribute : attributes) {
          if (!accessor(attribute, vertices)) return wrong("mesh", i, "has fewer attributes than vertices");
        }
        const QJsonValue indices = primitive["indices"];
        if (!indices.isUndefined()) {
          if (!accessor(indices)) return wrong("mesh", i, "names indices that are not there");
          const qint64 most = largest(indices);
          if (most < 0 || most >= vertices) return wrong("mesh", i, "has a triangle outside its vertices");
        }
        const QJsonValue material = primitive["material"];
        if (!material.isUndefined() && index(material, list("materials").size()) < 0) {
          return wrong("mesh", i, "names a material that is not there");
        }
      }
    }
    return ok();
  }

  /// Joints that vertices name must be in the skin that their mesh is shown with.
  Status joints() {
    const QJsonArray meshes = list("meshes"), skins = list("skins");
    for (const QJsonValue& node : list("nodes")) {
      if (node["skin"].isUndefined() || node["mesh"].isUndefined()) continue;
      const int mesh = node["mesh"].toInt();
      const qint64 count = skins[node["skin"].toInt()].toObject()["joints"].toArray().size();
      for (const QJsonValue& primitive : meshes[mesh].toObject()["primitives"].toArray()) {
        const QJsonObject attributes = primitive["attributes"].toObject();
        for (auto attribute = attributes.begin(); attribute != attributes.end(); ++attribute) {
          if (attribute.key().startsWith("JOINTS_") && largest(attribute.value()) >= count) {
            return wrong("mesh", mesh, "names a joint that its skin does not have");
          }
        }
      }
    }
    return ok();
  }

  const QJsonObject root_;
  const QByteArray chunk_;
  std::vector<QByteArray> buffers_, viewData_;
  std::vector<qint64> viewStrides_, accessorCounts_;
  qsizetype nodeCount_ = 0;
  int levels_ = 0;
};

}  // namespace

Result<int> checkGltf(const QByteArray& bytes, bool binary) {
  QByteArray json = bytes;
  QByteArray chunk;
  if (binary) {
    const auto word = [&](qsizetype at) { return qint64{qFromLittleEndian<quint32>(bytes.constData() + at)}; };
    if (bytes.size() < 20 || !bytes.startsWith("glTF")) return Error{"is not a .glb file"};
    if (word(4) != 2) return Error{"is not glTF 2.0"};
    const qint64 length = word(12);
    if (word(8) > bytes.size() || 20 + length > bytes.size()) return Error{"is cut off"};
    if (word(16) != 0x4e4f534a) return Error{"does not begin with its JSON chunk"};
    json = bytes.mid(20, length);
    const qint64 next = 20 + (length + 3) / 4 * 4;
    if (next + 8 <= bytes.size()) {
      if (next + 8 + word(next) > bytes.size()) return Error{"is cut off"};
      chunk = bytes.mid(next + 8, word(next));
    }
  }
  QJsonParseError problem;
  const QJsonDocument document = QJsonDocument::fromJson(json.trimmed(), &problem);
  if (!document.isObject()) {
    return Error{"is not glTF: " + problem.errorString().toStdString() + " at byte " + std::to_string(problem.offset)};
  }
  return Checker(document.object(), chunk).run();
}

}  // namespace windfall::model
