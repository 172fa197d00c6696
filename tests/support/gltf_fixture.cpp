#include "support/gltf_fixture.h"

#include <QtEndian>
#include <cstring>

namespace windfall::test {

int GltfFixture::add(const void* data, qsizetype bytes, int componentType, const char* type, qsizetype count) {
  QJsonArray views = root["bufferViews"].toArray(), accessors = root["accessors"].toArray();
  views.append(QJsonObject{{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes}});
  QJsonObject accessor{
      {"bufferView", views.size() - 1}, {"componentType", componentType}, {"type", type}, {"count", count}};
  if (qstrcmp(type, "VEC3") == 0) accessor["min"] = QJsonArray{-9, -9, -9}, accessor["max"] = QJsonArray{9, 9, 9};
  accessors.append(accessor);
  buffer.append(static_cast<const char*>(data), bytes);
  while (buffer.size() % 4 != 0) buffer.append('\0');
  root["bufferViews"] = views;
  root["accessors"] = accessors;
  root["buffers"] = QJsonArray{QJsonObject{{"byteLength", buffer.size()}}};
  return static_cast<int>(accessors.size()) - 1;
}

QJsonObject GltfFixture::primitive(const std::vector<vec3>& places, const std::vector<vec4>& weights,
                                   const std::vector<unsigned short>& indices, int material) {
  const auto count = static_cast<qsizetype>(places.size());
  std::vector<unsigned char> joints;
  for (qsizetype i = 0; i < count; ++i) joints.insert(joints.end(), {0, 1, 0, 0});
  QJsonObject attributes;
  attributes["POSITION"] = add(places.data(), count * 12, 5126, "VEC3", count);
  attributes["JOINTS_0"] = add(joints.data(), count * 4, 5121, "VEC4", count);
  attributes["WEIGHTS_0"] = add(weights.data(), count * 16, 5126, "VEC4", count);
  const auto indexCount = static_cast<qsizetype>(indices.size());
  const int index = add(indices.data(), indexCount * 2, 5123, "SCALAR", indexCount);
  return {{"attributes", attributes}, {"indices", index}, {"material", material}};
}

GltfFixture::GltfFixture() {
  root["asset"] = QJsonObject{{"version", "2.0"}};
  std::vector<vec3> tube;
  std::vector<vec4> weights;
  for (int ring = 0; ring < 5; ++ring) {
    const float y = 0.5f * static_cast<float>(ring);
    const float upper = ring < 2 ? 0 : ring == 2 ? 0.5f : 1;
    for (const vec2 corner : {vec2(-1, -1), vec2(-1, 1), vec2(1, 1), vec2(1, -1)}) {
      tube.emplace_back(0.1f * corner.x, y, 0.1f * corner.y);
      weights.emplace_back(1 - upper, upper, 0, 0);
    }
  }
  std::vector<unsigned short> sides;
  for (unsigned short ring = 0; ring < 4; ++ring) {
    for (unsigned short k = 0; k < 4; ++k) {
      const auto a = static_cast<unsigned short>(4 * ring + k), b = static_cast<unsigned short>(4 * ring + (k + 1) % 4);
      const auto c = static_cast<unsigned short>(a + 4), d = static_cast<unsigned short>(b + 4);
      sides.insert(sides.end(), {a, b, d, a, d, c});
    }
  }
  const std::vector<vec3> leaf{{0.1f, 1.5f, 0}, {0.15f, 1.5f, 0.02f}, {0.2f, 1.5f, 0}, {0.15f, 1.5f, -0.02f}};
  const std::vector<vec4> leafWeights(4, vec4(0, 1, 0, 0));
  const QJsonArray primitives{primitive(tube, weights, sides, 0), primitive(leaf, leafWeights, {0, 1, 2, 0, 2, 3}, 1)};
  root["meshes"] = QJsonArray{QJsonObject{{"name", "plant"}, {"primitives", primitives}}};

  const float bind[32] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                          1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1};
  const int matrices = add(bind, sizeof bind, 5126, "MAT4", 2);
  root["skins"] = QJsonArray{QJsonObject{{"joints", QJsonArray{2, 3}}, {"inverseBindMatrices", matrices}}};
  root["nodes"] = QJsonArray{QJsonObject{{"name", "rig"}, {"children", QJsonArray{1, 2}}},
                             QJsonObject{{"name", "body"}, {"mesh", 0}, {"skin", 0}},
                             QJsonObject{{"name", "lower"}, {"children", QJsonArray{3}}},
                             QJsonObject{{"name", "upper"}, {"translation", QJsonArray{0, 1, 0}}}};
  root["scenes"] = QJsonArray{QJsonObject{{"nodes", QJsonArray{0}}}};
  root["scene"] = 0;
  const auto material = [](const char* name, double r, double g, double b) {
    return QJsonObject{{"name", name},
                       {"pbrMetallicRoughness", QJsonObject{{"baseColorFactor", QJsonArray{r, g, b, 1}}}}};
  };
  root["materials"] = QJsonArray{material("bark", 0.4, 0.3, 0.2), material("summer_leaves", 0.1, 0.5, 0.1)};
  root["buffers"] = QJsonArray{QJsonObject{{"byteLength", buffer.size()}}};
}

QByteArray GltfFixture::gltf() const {
  QJsonObject copy = root;
  QJsonArray buffers = copy["buffers"].toArray();
  QJsonObject first = buffers[0].toObject();
  if (!first.contains("uri")) {
    first["uri"] = QString("data:application/octet-stream;base64," + QString::fromLatin1(buffer.toBase64()));
  }
  buffers[0] = first;
  copy["buffers"] = buffers;
  return QJsonDocument(copy).toJson(QJsonDocument::Compact);
}

QByteArray GltfFixture::glb() const {
  QByteArray json = QJsonDocument(root).toJson(QJsonDocument::Compact);
  while (json.size() % 4 != 0) json.append(' ');
  QByteArray file("glTF");
  const auto word = [&file](qsizetype value) {
    const quint32 little = qToLittleEndian(static_cast<quint32>(value));
    file.append(reinterpret_cast<const char*>(&little), 4);
  };
  word(2), word(12 + 8 + json.size() + 8 + buffer.size());
  word(json.size()), word(0x4e4f534a);
  file.append(json);
  word(buffer.size()), word(0x004e4942);
  file.append(buffer);
  return file;
}

void GltfFixture::setFloat(qsizetype byteOffset, float value) { std::memcpy(buffer.data() + byteOffset, &value, 4); }

void GltfFixture::set(const char* list, int index, const char* key, const QJsonValue& value) {
  QJsonArray array = root[QLatin1String(list)].toArray();
  QJsonObject object = array[index].toObject();
  object[QLatin1String(key)] = value;
  array[index] = object;
  root[QLatin1String(list)] = array;
}

}  // namespace windfall::test
