// The container of a glTF 2.0 file: JSON, one binary buffer, pictures.
#pragma once

#include <QByteArray>
#include <QImage>
#include <QJsonArray>
#include <QJsonObject>
#include <QStringList>
#include <map>
#include <vector>

#include "kernels/math.h"

namespace windfall::model {

/// Collects accessors, pictures and the arrays of a glTF document.
class GltfWriter {
 public:
  /// Index of a new accessor; `target` 34962 for vertices, 34963 for indices, 0 for other data.
  int floats(const std::vector<float>& values, int components, int target, bool bounds = false);
  int bytes(const std::vector<std::uint8_t>& values, int components, bool normalized);
  int shorts(const std::vector<std::uint16_t>& values, int components);
  int indices(const std::vector<std::uint32_t>& values);
  /// Index of a texture for a picture, as PNG.
  int texture(const QImage& image, const QString& name);
  /// Appends to a top-level array ("nodes", "meshes", …); the index there.
  int add(const QString& array, const QJsonObject& object);
  QJsonObject& at(const QString& array, int index);
  void useExtension(const QString& name);

  /// One .glb.
  QByteArray binary(const QString& scene, const QJsonArray& roots);
  /// A .gltf whose buffer is the file `bufferName` beside it: `buffer` gets its bytes.
  QByteArray text(const QString& scene, const QJsonArray& roots, const QString& bufferName, QByteArray& buffer);

 private:
  int view(const QByteArray& data, int target);
  int accessor(int view, int componentType, int count, int components, bool normalized);
  QByteArray json(const QString& scene, const QJsonArray& roots, const QString& bufferName);

  QByteArray buffer_;
  std::map<QString, std::vector<QJsonObject>> arrays_;
  QStringList extensions_;
};

}  // namespace windfall::model
