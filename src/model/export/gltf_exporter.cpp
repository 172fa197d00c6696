#include "model/export/gltf_exporter.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <algorithm>
#include <cmath>

#include "model/document/durable_file.h"
#include "model/export/gltf_writer.h"
#include "model/export/tangents.h"
#include "model/progress_part.h"

namespace windfall::model {

namespace {

constexpr int kVertices = 34962;

std::size_t at(int index) { return static_cast<std::size_t>(index); }

QJsonArray json(vec3 v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }
QJsonArray json(quat q) {
  return {static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z), static_cast<double>(q.w)};
}

template <class V>
void append(std::vector<float>& out, const V& v) {
  for (int k = 0; k < V::length(); ++k) out.push_back(v[k]);
}

template <class V>
std::vector<float> flat(const std::vector<V>& vectors) {
  std::vector<float> out;
  out.reserve(vectors.size() * static_cast<std::size_t>(V::length()));
  for (const V& v : vectors) append(out, v);
  return out;
}

/// Arrays of one skinned mesh.
struct SkinnedArrays {
  std::vector<vec3> positions, normals;
  std::vector<vec2> uvs;
  std::vector<float> weights;
  std::vector<std::uint16_t> joints;
  std::vector<std::uint8_t> colours;
};

class GltfPlant {
 public:
  explicit GltfPlant(const PlantModel& model) : model_(model) {}

  QByteArray write(LeafExport leaves, const QString& bufferName, QByteArray* buffer) {
    addJoints();
    for (const Material& material : model_.geometry.materials) bark_.push_back(addMaterial(material));
    const int mesh = addSkinnedMesh(model_.name, model_.geometry);
    roots_.append(mesh);
    addLevels(mesh);
    if (!model_.leaves.empty()) {
      for (const LeafShape& shape : model_.shapes) leafMaterials_.push_back(addLeafMaterial(shape));
      if (leaves == LeafExport::Merged) {
        const int merged = addMergedLeaves();
        roots_.append(merged);
        addCards(merged);
      }
      if (leaves == LeafExport::Nodes) addLeafNodes();
      if (leaves == LeafExport::Instances) addLeafInstances();
    }
    for (const Clip& clip : model_.clips) addClip(clip);
    return buffer == nullptr ? out_.binary(model_.name, roots_) : out_.text(model_.name, roots_, bufferName, *buffer);
  }

 private:
  const std::vector<Bone>& bones() const { return model_.geometry.bones; }

  /// Node i is bone i.
  void addJoints() {
    std::vector<QJsonArray> children(bones().size());
    for (std::size_t b = 0; b < bones().size(); ++b) {
      const Bone& bone = bones()[b];
      const vec3 from = bone.parent < 0 ? vec3(0) : bones()[at(bone.parent)].head;
      out_.add("nodes", {{"name", bone.name}, {"translation", json(bone.head - from)}});
      if (bone.parent < 0) {
        roots_.append(static_cast<int>(b));
      } else {
        children[at(bone.parent)].append(static_cast<int>(b));
      }
    }
    std::vector<float> inverse;
    QJsonArray joints;
    for (std::size_t b = 0; b < bones().size(); ++b) {
      if (!children[b].isEmpty()) out_.at("nodes", static_cast<int>(b))["children"] = children[b];
      mat4 bind(1);
      bind[3] = vec4(-bones()[b].head, 1);
      for (int c = 0; c < 4; ++c) append(inverse, bind[c]);
      joints.append(static_cast<int>(b));
    }
    QJsonObject skin{{"joints", joints}, {"inverseBindMatrices", out_.floats(inverse, 16, 0)}};
    out_.add("skins", skin);
  }

  void addChild(int node, int child) {
    QJsonObject& parent = out_.at("nodes", node);
    QJsonArray children = parent["children"].toArray();
    children.append(child);
    parent["children"] = children;
  }

  int addMaterial(const Material& material) {
    QJsonObject look{{"metallicFactor", 0}, {"roughnessFactor", static_cast<double>(material.roughness)}};
    const vec4 c = material.baseColor;
    look["baseColorFactor"] =
        QJsonArray{std::clamp(static_cast<double>(c.x), 0.0, 1.0), std::clamp(static_cast<double>(c.y), 0.0, 1.0),
                   std::clamp(static_cast<double>(c.z), 0.0, 1.0), 1.0};
    QJsonObject out{{"name", material.name.isEmpty() ? QStringLiteral("material") : material.name}};
    if (!material.texture.isNull()) {
      look["baseColorTexture"] = QJsonObject{{"index", out_.texture(material.texture, material.name)}};
    }
    if (!material.normalMap.isNull()) {
      out["normalTexture"] = QJsonObject{{"index", out_.texture(material.normalMap, material.name + " normal")}};
    }
    out["pbrMetallicRoughness"] = look;
    if (material.doubleSided) out["doubleSided"] = true;
    if (material.leaf) out["alphaMode"] = "MASK";
    return out_.add("materials", out);
  }

  int addLeafMaterial(const LeafShape& shape) {
    Material material;
    material.name = shape.name;
    material.baseColor = vec4(1);
    material.texture = shape.image;
    material.normalMap = shape.normalMap;
    material.roughness = 0.6f;
    material.leaf = material.doubleSided = true;
    return addMaterial(material);
  }

  /// With tangents where the material has a normal map.
  QJsonObject shapeAttributes(const std::vector<vec3>& positions, const std::vector<vec3>& normals,
                              const std::vector<vec2>& uvs, const std::vector<std::uint32_t>& indices, int material) {
    QJsonObject result{{"POSITION", out_.floats(flat(positions), 3, kVertices, true)},
                       {"NORMAL", out_.floats(flat(normals), 3, kVertices)},
                       {"TEXCOORD_0", out_.floats(flat(uvs), 2, kVertices)}};
    if (out_.at("materials", material).contains("normalTexture")) {
      result["TANGENT"] = out_.floats(flat(tangentsOf(positions, normals, uvs, indices)), 4, kVertices);
    }
    return result;
  }

  QJsonObject primitive(const SkinnedArrays& arrays, const std::vector<std::uint32_t>& indices, int material,
                        bool coloured) {
    QJsonObject result = shapeAttributes(arrays.positions, arrays.normals, arrays.uvs, indices, material);
    result["WEIGHTS_0"] = out_.floats(arrays.weights, 4, kVertices);
    if (coloured) result["COLOR_0"] = out_.bytes(arrays.colours, 4, true);
    if (bones().size() > 255) {
      result["JOINTS_0"] = out_.shorts(arrays.joints, 4);
    } else {
      result["JOINTS_0"] = out_.bytes({arrays.joints.begin(), arrays.joints.end()}, 4, false);
    }
    return {{"attributes", result}, {"indices", out_.indices(indices)}, {"material", material}};
  }

  /// The vertices that a part uses, in arrays of its own: readers split shared ones badly.
  QJsonObject primitiveOf(const PlantGeometry& geometry, const MeshPart& part) {
    SkinnedArrays arrays;
    bool coloured = false;
    std::vector<std::uint32_t> place(geometry.vertices.size(), ~0u), indices;
    std::uint32_t used = 0;
    for (std::uint32_t i = part.firstIndex; i < part.firstIndex + part.indexCount; ++i) {
      std::uint32_t& to = place[geometry.indices[i]];
      if (to == ~0u) {
        to = used++;
        coloured = appendVertex(geometry.vertices[geometry.indices[i]], arrays) || coloured;
      }
      indices.push_back(to);
    }
    return primitive(arrays, indices, bark_[at(part.material)], coloured);
  }

  /// True where the vertex has a colour.
  static bool appendVertex(const Vertex& vertex, SkinnedArrays& arrays) {
    arrays.positions.push_back(vertex.position);
    const float length = glm::length(vertex.normal);
    arrays.normals.push_back(length > 1e-6f ? vertex.normal / length : vec3(0, 1, 0));
    arrays.uvs.push_back(vertex.uv);
    float sum = 0;
    for (const float weight : vertex.weights) sum += weight;
    for (std::size_t k = 0; k < 4; ++k) {
      const float weight = sum > 0 ? vertex.weights[k] / sum : (k == 0 ? 1.0f : 0.0f);
      arrays.weights.push_back(weight);
      arrays.joints.push_back(weight > 0 ? static_cast<std::uint16_t>(vertex.bones[k]) : std::uint16_t{0});
    }
    bool coloured = false;
    for (std::size_t k = 0; k < 3; ++k) {
      arrays.colours.push_back(tinted(vertex, k));
      coloured = coloured || arrays.colours.back() != 255;
    }
    arrays.colours.push_back(255);
    return coloured;
  }

  /// The node of a mesh with a primitive a part.
  int addSkinnedMesh(const QString& name, const PlantGeometry& geometry) {
    QJsonArray primitives;
    for (const MeshPart& part : geometry.parts) primitives.append(primitiveOf(geometry, part));
    if (primitives.isEmpty()) return out_.add("nodes", {{"name", name}});
    const int mesh = out_.add("meshes", {{"name", name}, {"primitives", primitives}});
    return out_.add("nodes", {{"name", name}, {"mesh", mesh}, {"skin", 0}});
  }

  /// What the window's shader mixes, as a factor: green where there is no wood yet.
  static std::uint8_t tinted(const Vertex& vertex, std::size_t channel) {
    constexpr float kGreen[3] = {0.62f, 0.86f, 0.34f};
    const float wood = static_cast<float>(vertex.tint[3]) / 255, green = kGreen[channel];
    return static_cast<std::uint8_t>(
        std::lround(static_cast<float>(vertex.tint[channel]) * (green + (1 - green) * wood)));
  }

  void addLevels(int finest) {
    if (model_.coarser.empty()) return;
    QJsonArray ids, cover;
    for (std::size_t i = 0; i < model_.coarser.size(); ++i) {
      ids.append(addSkinnedMesh(QStringLiteral("%1 level %2").arg(model_.name).arg(i + 1), model_.coarser[i]));
      cover.append(0.3 / static_cast<double>(i + 1));
    }
    cover.append(0.01);
    out_.at("nodes", finest)["extensions"] = QJsonObject{{"MSFT_lod", QJsonObject{{"ids", ids}}}};
    out_.at("nodes", finest)["extras"] = QJsonObject{{"MSFT_screencoverage", cover}};
    out_.useExtension("MSFT_lod");
  }

  int addMergedLeaves() {
    QJsonArray primitives;
    for (std::size_t s = 0; s < model_.shapes.size(); ++s) {
      const LeafShape& shape = model_.shapes[s];
      SkinnedArrays arrays;
      std::vector<std::uint32_t> indices;
      for (const PlacedLeaf& leaf : model_.leaves) {
        if (leaf.shape != static_cast<int>(s)) continue;
        const auto first = static_cast<std::uint32_t>(arrays.positions.size());
        for (std::size_t i = 0; i < shape.positions.size(); ++i) {
          arrays.positions.push_back(leaf.position + leaf.rotation * (leaf.size * shape.positions[i]));
          arrays.normals.push_back(glm::normalize(leaf.rotation * shape.normals[i]));
          arrays.uvs.push_back(shape.uvs[i]);
          append(arrays.weights, vec4(1, 0, 0, 0));
          for (const int joint : {leaf.bone, 0, 0, 0}) arrays.joints.push_back(static_cast<std::uint16_t>(joint));
        }
        for (const std::uint32_t index : shape.indices) indices.push_back(first + index);
      }
      if (indices.empty()) continue;
      primitives.append(primitive(arrays, indices, leafMaterials_[s], false));
    }
    const int mesh = out_.add("meshes", {{"name", "leaves"}, {"primitives", primitives}});
    return out_.add("nodes", {{"name", "leaves"}, {"mesh", mesh}, {"skin", 0}});
  }

  /// What the merged leaves are from afar.
  void addCards(int leaves) {
    const LeafCards& cards = model_.cards;
    if (cards.indices.empty()) return;
    Material look;
    look.name = QStringLiteral("leaf cards");
    look.baseColor = vec4(1);
    look.texture = cards.image;
    look.roughness = 0.7f;
    look.leaf = look.doubleSided = true;
    SkinnedArrays arrays;
    arrays.positions = cards.positions;
    arrays.normals = cards.normals;
    arrays.uvs = cards.uvs;
    for (const int bone : cards.bones) {
      append(arrays.weights, vec4(1, 0, 0, 0));
      for (const int joint : {bone, 0, 0, 0}) arrays.joints.push_back(static_cast<std::uint16_t>(joint));
    }
    const QJsonArray primitives{primitive(arrays, cards.indices, addMaterial(look), false)};
    const int mesh = out_.add("meshes", {{"name", "leaf cards"}, {"primitives", primitives}});
    const int node = out_.add("nodes", {{"name", "leaf cards"}, {"mesh", mesh}, {"skin", 0}});
    out_.at("nodes", leaves)["extensions"] = QJsonObject{{"MSFT_lod", QJsonObject{{"ids", QJsonArray{node}}}}};
    out_.at("nodes", leaves)["extras"] = QJsonObject{{"MSFT_screencoverage", QJsonArray{0.15, 0.01}}};
    out_.useExtension("MSFT_lod");
  }

  /// A mesh for each shape that is used.
  int leafMesh(int index) {
    if (leafMeshes_.empty()) leafMeshes_.assign(model_.shapes.size(), -1);
    int& mesh = leafMeshes_[at(index)];
    if (mesh >= 0) return mesh;
    const LeafShape& shape = model_.shapes[at(index)];
    const int material = leafMaterials_[at(index)];
    const QJsonObject own = shapeAttributes(shape.positions, shape.normals, shape.uvs, shape.indices, material);
    const QJsonObject primitive{{"attributes", own}, {"indices", out_.indices(shape.indices)}, {"material", material}};
    mesh = out_.add("meshes", {{"name", shape.name}, {"primitives", QJsonArray{primitive}}});
    return mesh;
  }

  void addLeafNodes() {
    for (std::size_t i = 0; i < model_.leaves.size(); ++i) {
      const PlacedLeaf& leaf = model_.leaves[i];
      const double size = static_cast<double>(leaf.size);
      addLater(leaf.bone, out_.add("nodes", {{"name", QStringLiteral("leaf.%1").arg(i)},
                                             {"mesh", leafMesh(leaf.shape)},
                                             {"translation", json(leaf.position - bones()[at(leaf.bone)].head)},
                                             {"rotation", json(leaf.rotation)},
                                             {"scale", QJsonArray{size, size, size}}}));
    }
    addNow();
  }

  /// Children of joints, gathered so that no list is copied once a leaf.
  void addLater(int joint, int node) { hanging_[joint].append(node); }
  void addNow() {
    for (const auto& [joint, nodes] : hanging_) {
      QJsonArray children = out_.at("nodes", joint)["children"].toArray();
      for (const QJsonValue node : nodes) children.append(node);
      out_.at("nodes", joint)["children"] = children;
    }
  }

  void addLeafInstances() {
    std::map<std::pair<int, int>, std::vector<const PlacedLeaf*>> groups;
    for (const PlacedLeaf& leaf : model_.leaves) groups[{leaf.bone, leaf.shape}].push_back(&leaf);
    for (const auto& [key, leaves] : groups) {
      const auto [bone, shape] = key;
      std::vector<float> places, turns, sizes;
      for (const PlacedLeaf* leaf : leaves) {
        append(places, leaf->position - bones()[at(bone)].head);
        append(turns, vec4(leaf->rotation.x, leaf->rotation.y, leaf->rotation.z, leaf->rotation.w));
        append(sizes, vec3(leaf->size));
      }
      const QJsonObject attributes{{"TRANSLATION", out_.floats(places, 3, 0)},
                                   {"ROTATION", out_.floats(turns, 4, 0)},
                                   {"SCALE", out_.floats(sizes, 3, 0)}};
      const QJsonObject extension{{"EXT_mesh_gpu_instancing", QJsonObject{{"attributes", attributes}}}};
      addLater(bone, out_.add("nodes", {{"name", bones()[at(bone)].name + " leaves"},
                                        {"mesh", leafMesh(shape)},
                                        {"extensions", extension}}));
    }
    addNow();
    out_.useExtension("EXT_mesh_gpu_instancing");
  }

  void addClip(const Clip& clip) {
    std::map<QString, int> boneOf;
    for (std::size_t b = 0; b < bones().size(); ++b) boneOf.emplace(bones()[b].name, static_cast<int>(b));
    // Tracks of one rate have the same times: written once.
    std::map<std::vector<float>, int> times;
    QJsonArray samplers, channels;
    const auto channel = [&](int input, int output, int node, const char* path) {
      channels.append(
          QJsonObject{{"sampler", samplers.size()}, {"target", QJsonObject{{"node", node}, {"path", path}}}});
      samplers.append(QJsonObject{{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
    };
    for (const ClipTrack& track : clip.tracks) {
      const auto bone = boneOf.find(track.bone);
      if (bone == boneOf.end() || track.times.empty() || track.rotations.size() != track.times.size()) continue;
      auto [input, isNew] = times.try_emplace(track.times, 0);
      if (isNew) input->second = out_.floats(track.times, 1, 0, true);
      std::vector<float> turns, places;
      for (const quat& q : track.rotations) append(turns, vec4(q.x, q.y, q.z, q.w));
      channel(input->second, out_.floats(turns, 4, 0), bone->second, "rotation");
      if (track.shifts.size() != track.times.size()) continue;
      const Bone& own = bones()[at(bone->second)];
      const vec3 rest = own.head - (own.parent < 0 ? vec3(0) : bones()[at(own.parent)].head);
      for (const vec3& shift : track.shifts) append(places, rest + shift);
      channel(input->second, out_.floats(places, 3, 0), bone->second, "translation");
    }
    if (!channels.isEmpty()) {
      out_.add("animations", {{"name", clip.name}, {"samplers", samplers}, {"channels", channels}});
    }
  }

  const PlantModel& model_;
  GltfWriter out_;
  QJsonArray roots_;
  std::vector<int> bark_, leafMaterials_, leafMeshes_;
  std::map<int, QJsonArray> hanging_;
};

}  // namespace

QString GltfExporter::title() const { return QCoreApplication::translate("Exporter", "Plant (glTF 2.0)"); }

std::vector<ExportParameter> plantExportParameters() {
  const auto text = [](const char* source) { return QCoreApplication::translate("Exporter", source); };
  const QStringList leaves{
      text(QT_TRANSLATE_NOOP("Exporter", "Instances")), text(QT_TRANSLATE_NOOP("Exporter", "One skinned mesh")),
      text(QT_TRANSLATE_NOOP("Exporter", "An object each")), text(QT_TRANSLATE_NOOP("Exporter", "None"))};
  const QStringList meshes{
      text(QT_TRANSLATE_NOOP("Exporter", "Automatic")), text(QT_TRANSLATE_NOOP("Exporter", "Fine, folded and bent")),
      text(QT_TRANSLATE_NOOP("Exporter", "Medium, folded and bent")), text(QT_TRANSLATE_NOOP("Exporter", "Hull, flat")),
      text(QT_TRANSLATE_NOOP("Exporter", "Rectangle, flat"))};
  return {
      {"detail",
       text(QT_TRANSLATE_NOOP("Exporter", "Detail")),
       -1,
       -1,
       1,
       false,
       {},
       text(QT_TRANSLATE_NOOP("Exporter", "How fine the mesh is, 0 to 1; -1 is the plant's own"))},
      {"bones",
       text(QT_TRANSLATE_NOOP("Exporter", "Most bones")),
       0,
       0,
       65535,
       true,
       {},
       text(QT_TRANSLATE_NOOP("Exporter", "More are merged into those that carry them; 0 keeps all"))},
      {"depth",
       text(QT_TRANSLATE_NOOP("Exporter", "Bone depth")),
       0,
       0,
       1000,
       true,
       {},
       text(QT_TRANSLATE_NOOP("Exporter", "Most bones from the root to a tip; 0 allows any"))},
      {"leaves", text(QT_TRANSLATE_NOOP("Exporter", "Leaves")), 1, 0, 3, true, leaves,
       text(
           QT_TRANSLATE_NOOP("Exporter", "Instances are small files that few programs read; one mesh is read by all"))},
      {"leafMesh", text(QT_TRANSLATE_NOOP("Exporter", "Leaf mesh")), 0, 0, 4, true, meshes,
       text(QT_TRANSLATE_NOOP("Exporter", "How finely a leaf follows its contour; automatic: the hull for very many"))},
      {"levels",
       text(QT_TRANSLATE_NOOP("Exporter", "Levels of detail")),
       1,
       1,
       4,
       true,
       {},
       text(QT_TRANSLATE_NOOP("Exporter", "Coarser meshes beside the finest"))}};
}

Result<PlantExportOptions> plantExportOptions(const Exporter& exporter, const QJsonObject& values) {
  std::map<QString, double> numbers;
  for (const ExportParameter& parameter : exporter.parameters()) {
    const Result<double> value = parameterValue(exporter, values, parameter.key);
    if (!value) return value.error();
    numbers[parameter.key] = *value;
  }
  const auto number = [&](const char* key, int otherwise) {
    const auto found = numbers.find(QLatin1String(key));
    return found == numbers.end() ? otherwise : static_cast<int>(found->second);
  };
  PlantExportOptions options;
  options.detail = numbers["detail"];
  options.bones = {number("bones", 0), number("depth", 0)};
  options.leaves = static_cast<LeafExport>(number("leaves", static_cast<int>(LeafExport::Merged)));
  options.leafMesh = static_cast<LeafExportMesh>(number("leafMesh", 0));
  options.levels = number("levels", 1);
  return options;
}

std::vector<ExportParameter> GltfExporter::parameters() const { return plantExportParameters(); }

QByteArray gltfOf(const PlantModel& model, LeafExport leaves, const QString& bufferName, QByteArray* buffer) {
  return GltfPlant(model).write(leaves, bufferName, buffer);
}

Status GltfExporter::write(const Project& project, AssetId asset, const QString& path, const QJsonObject& values,
                           Progress& progress) const {
  const Result<PlantExportOptions> options = plantExportOptions(*this, values);
  if (!options) return options.error();
  const Result<PlantModel> model = modelOf(project, asset, *options, progress);
  if (!model) return model.error();
  if (model->geometry.bones.size() > 65535) return Error{"has more than 65535 bones; set a limit"};
  const QFileInfo target(path);
  if (target.suffix().toLower() != QLatin1String("gltf")) {
    if (const Status written = writeDurably(path, gltfOf(*model, options->leaves)); !written) return written;
  } else {
    // The .gltf comes last: where it stands, its buffer does too.
    const QString name = target.completeBaseName() + QStringLiteral(".bin");
    QByteArray buffer;
    const QByteArray text =
        gltfOf(*model, options->leaves, QString::fromLatin1(name.toUtf8().toPercentEncoding()), &buffer);
    if (const Status written = writeDurably(target.path() + '/' + name, buffer); !written) {
      return Error{name.toStdString() + ": " + written.error().message};
    }
    if (const Status written = writeDurably(path, text); !written) return written;
  }
  progress.report(1);
  return ok();
}

}  // namespace windfall::model
