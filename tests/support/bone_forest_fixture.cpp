#include "support/bone_forest_fixture.h"

#include <QJsonArray>
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "kernels/random.h"
#include "support/fbx_binary_fixture.h"
#include "support/gltf_fixture.h"

namespace windfall::test {

namespace {

constexpr int kJoints = 50'000;  // of a skin

std::size_t at(int index) { return static_cast<std::size_t>(index); }

const vec2 kCorners[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

/// The eight vertices of a bone's tube: four round its head, four round its tail.
std::vector<vec3> tubeOf(const BoneForest& forest, int bone) {
  std::vector<vec3> places;
  for (const vec3& end : {forest.head[at(bone)], forest.tail[at(bone)]}) {
    for (const vec2& corner : kCorners) {
      places.push_back(end + forest.radius[at(bone)] * vec3(corner.x, 0, corner.y));
    }
  }
  return places;
}

}  // namespace

BoneForest::BoneForest(int count, int fan) : bones(count), fanOut(fan) {
  std::vector<int> depth;
  std::vector<vec3> direction;
  for (int i = 0; i < count; ++i) {
    const int up = i == 0 ? -1 : (i - 1) / fan;
    parent.push_back(up);
    depth.push_back(up < 0 ? 0 : depth[at(up)] + 1);
    vec3 along(0, 1, 0);
    if (up >= 0 && fan > 1) {
      const auto draw = [i](std::uint32_t k) { return uniform(5, static_cast<std::uint32_t>(i), k, 0) - 0.5f; };
      along = glm::normalize(direction[at(up)] + 1.2f * vec3(draw(0), draw(1), draw(2)));
    }
    direction.push_back(along);
    const float share = fan > 1 ? std::pow(0.75f, static_cast<float>(depth.back())) : 1;
    head.push_back(up < 0 ? vec3(0) : tail[at(up)]);
    tail.push_back(head.back() + along * (fan > 1 ? 2 * share : 100.f / static_cast<float>(count)));
    radius.push_back(fan > 1 ? 0.05f * share : 0.005f);
  }
}

QByteArray gltfOf(const BoneForest& forest) {
  GltfFixture file;
  std::vector<QJsonArray> children(at(forest.bones));
  for (int i = 1; i < forest.bones; ++i) children[at(forest.parent[at(i)])].append(1 + i);
  QJsonArray nodes{QJsonObject()}, rig{1}, meshes, skins;
  for (int i = 0; i < forest.bones; ++i) {
    const int up = forest.parent[at(i)];
    const vec3 place = forest.head[at(i)] - (up < 0 ? vec3(0) : forest.head[at(up)]);
    QJsonObject node{{"name", QStringLiteral("bone%1").arg(i)},
                     {"translation", QJsonArray{double(place.x), double(place.y), double(place.z)}}};
    if (!children[at(i)].isEmpty()) node["children"] = children[at(i)];
    nodes.append(node);
  }
  for (int first = 0; first < forest.bones; first += kJoints) {
    const int last = std::min(forest.bones, first + kJoints);
    std::vector<vec3> places;
    std::vector<vec4> weights;
    std::vector<quint16> joints;
    std::vector<quint32> indices;
    std::vector<mat4> binds;
    QJsonArray names;
    for (int i = first; i < last; ++i) {
      const auto base = static_cast<quint32>(places.size());
      for (const vec3& place : tubeOf(forest, i)) {
        places.push_back(place);
        weights.emplace_back(1, 0, 0, 0);
        joints.insert(joints.end(), {static_cast<quint16>(i - first), 0, 0, 0});
      }
      for (quint32 k = 0; k < 4; ++k) {
        const quint32 a = base + k, b = base + (k + 1) % 4;
        indices.insert(indices.end(), {a, b, b + 4, a, b + 4, a + 4});
      }
      mat4 bind(1);
      bind[3] = vec4(-forest.head[at(i)], 1);
      binds.push_back(bind);
      names.append(1 + i);
    }
    const auto vertices = static_cast<qsizetype>(places.size()), corners = static_cast<qsizetype>(indices.size());
    const auto bones = static_cast<qsizetype>(binds.size());
    const QJsonObject attributes{{"POSITION", file.add(places.data(), 12 * vertices, 5126, "VEC3", vertices)},
                                 {"JOINTS_0", file.add(joints.data(), 8 * vertices, 5123, "VEC4", vertices)},
                                 {"WEIGHTS_0", file.add(weights.data(), 16 * vertices, 5126, "VEC4", vertices)}};
    const int triangles = file.add(indices.data(), 4 * corners, 5125, "SCALAR", corners);
    meshes.append(QJsonObject{
        {"primitives", QJsonArray{QJsonObject{{"attributes", attributes}, {"indices", triangles}, {"material", 0}}}}});
    skins.append(QJsonObject{{"joints", names},
                             {"inverseBindMatrices", file.add(binds.data(), 64 * bones, 5126, "MAT4", bones)}});
    rig.append(nodes.size());
    nodes.append(QJsonObject{
        {"name", QStringLiteral("body%1").arg(first)}, {"mesh", meshes.size() - 1}, {"skin", skins.size() - 1}});
  }
  nodes[0] = QJsonObject{{"name", "rig"}, {"children", rig}};
  file.root["nodes"] = nodes, file.root["meshes"] = meshes, file.root["skins"] = skins;
  return file.glb();
}

QByteArray fbxOf(const BoneForest& forest) {
  const auto property = [](const char* name, const char* kind, const char* type, const auto& put) {
    FbxRecord record("P");
    record.text(name).text(kind).text(type).text("");
    put(record);
    return record;
  };
  FbxRecord header("FBXHeaderExtension");
  header.add(FbxRecord("FBXHeaderVersion")).integer(1003);
  header.add(FbxRecord("FBXVersion")).integer(7400);
  FbxRecord settings("GlobalSettings");
  FbxRecord& all = settings.add(FbxRecord("Properties70"));
  for (const auto& [name, value] :
       {std::pair{"UpAxis", 1}, {"UpAxisSign", 1}, {"FrontAxis", 2}, {"FrontAxisSign", 1}, {"CoordAxis", 0}}) {
    all.add(property(name, "int", "Integer", [value = value](FbxRecord& p) { p.integer(value); }));
  }
  all.add(property("UnitScaleFactor", "double", "Number", [](FbxRecord& p) { p.number(100); }));

  constexpr qint64 kMesh = 1, kBody = 2, kSkin = 3, kBone = 1'000'000, kCluster = 100'000'000;
  FbxRecord objects("Objects"), connections("Connections");
  const auto connect = [&](qint64 from, qint64 to) { connections.add(FbxRecord("C")).text("OO").id(from).id(to); };
  std::vector<double> places;
  std::vector<int> corners;
  for (int i = 0; i < forest.bones; ++i) {
    const int base = 8 * i;
    for (const vec3& place : tubeOf(forest, i)) {
      places.insert(places.end(), {double(place.x), double(place.y), double(place.z)});
    }
    for (int k = 0; k < 4; ++k) {
      const int a = base + k, b = base + (k + 1) % 4;
      corners.insert(corners.end(), {a, b, b + 4, -(a + 4) - 1});
    }
  }
  FbxRecord& mesh = objects.add(FbxRecord("Geometry"));
  mesh.id(kMesh).object("tubes", "Geometry").text("Mesh");
  mesh.add(FbxRecord("Vertices")).numbers(places);
  mesh.add(FbxRecord("PolygonVertexIndex")).integers(corners);
  objects.add(FbxRecord("Model")).id(kBody).object("body", "Model").text("Mesh").add(FbxRecord("Version")).integer(232);
  objects.add(FbxRecord("Deformer"))
      .id(kSkin)
      .object("skin", "Deformer")
      .text("Skin")
      .add(FbxRecord("Version"))
      .integer(101);
  connect(kBody, 0), connect(kMesh, kBody), connect(kSkin, kMesh);
  for (int i = 0; i < forest.bones; ++i) {
    const int up = forest.parent[at(i)];
    const vec3 head = forest.head[at(i)], place = head - (up < 0 ? vec3(0) : forest.head[at(up)]);
    FbxRecord& bone = objects.add(FbxRecord("Model"));
    bone.id(kBone + i).object("bone" + QByteArray::number(i), "Model").text("LimbNode");
    bone.add(FbxRecord("Version")).integer(232);
    bone.add(FbxRecord("Properties70")).add(property("Lcl Translation", "Lcl Translation", "", [&](FbxRecord& p) {
      p.number(double(place.x)).number(double(place.y)).number(double(place.z));
    }));
    FbxRecord& cluster = objects.add(FbxRecord("Deformer"));
    cluster.id(kCluster + i).object("c" + QByteArray::number(i), "SubDeformer").text("Cluster");
    cluster.add(FbxRecord("Version")).integer(100);
    std::vector<int> own;
    for (int k = 0; k < 8; ++k) own.push_back(8 * i + k);
    cluster.add(FbxRecord("Indexes")).integers(own);
    cluster.add(FbxRecord("Weights")).numbers(std::vector<double>(8, 1.0));
    const auto moved = [&](double sign) {
      return std::vector<double>{
          1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, sign * double(head.x), sign * double(head.y), sign * double(head.z), 1};
    };
    cluster.add(FbxRecord("Transform")).numbers(moved(-1));
    cluster.add(FbxRecord("TransformLink")).numbers(moved(1));
    connect(kBone + i, up < 0 ? 0 : kBone + up), connect(kCluster + i, kSkin), connect(kBone + i, kCluster + i);
  }
  return fbxBinary({header, settings, objects, connections});
}

}  // namespace windfall::test
