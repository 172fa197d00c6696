// Tiny skinned plants as glTF, made by the tests themselves.
#pragma once

#include <QByteArray>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <vector>

#include "kernels/math.h"

namespace windfall::test {

/// A glTF document whose parts a test may change before it is written.
class GltfFixture {
 public:
  /// A trunk of two bones, 1 m each, a square tube of 0.1 m half width round it, and one small leaf triangle pair in a
  /// material of its own beside the upper bone.
  GltfFixture();

  QJsonObject root;
  QByteArray buffer;

  QByteArray gltf() const;  ///< JSON with the buffer in base64
  QByteArray glb() const;
  /// Overwrites a float of the buffer.
  void setFloat(qsizetype byteOffset, float value);
  /// Replaces a key of element `index` of a top-level array.
  void set(const char* list, int index, const char* key, const QJsonValue& value);
  /// Appends data with its view and accessor; the accessor's index. The buffer's length is brought up to date.
  int add(const void* data, qsizetype bytes, int componentType, const char* type, qsizetype count);

 private:
  QJsonObject primitive(const std::vector<vec3>& places, const std::vector<vec4>& weights,
                        const std::vector<unsigned short>& indices, int material);
};

}  // namespace windfall::test
