#include "model/export/obj_exporter.h"

#include <QBuffer>
#include <QCoreApplication>
#include <QFileInfo>
#include <cmath>

#include "model/document/durable_file.h"
#include "model/export/gltf_exporter.h"

namespace windfall::model {

namespace {

QByteArray number(float value) { return QByteArray::number(static_cast<double>(value), 'g', 7); }

QByteArray materialName(size_t index) { return "material" + QByteArray::number(static_cast<qulonglong>(index)); }

/// Linear to sRGB: MTL colours are seen as they are by most programs.
float encoded(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

QByteArray commentOf(const QString& name) { return "# " + name.simplified().toUtf8() + "\n"; }

}  // namespace

QString ObjExporter::title() const { return QCoreApplication::translate("Exporter", "Plant mesh (Wavefront OBJ)"); }

QByteArray objText(const PlantGeometry& geometry, const QString& library) {
  QByteArray text = "# Windfall; metres, Y up\nmtllib " + library.toUtf8() + "\n";
  for (const Vertex& vertex : geometry.vertices) {
    const vec3& p = vertex.position;
    text += "v " + number(p.x) + ' ' + number(p.y) + ' ' + number(p.z) + '\n';
  }
  // OBJ counts textures from the bottom, Windfall from the top.
  for (const Vertex& vertex : geometry.vertices) {
    text += "vt " + number(vertex.uv.x) + ' ' + number(1 - vertex.uv.y) + '\n';
  }
  for (const Vertex& vertex : geometry.vertices) {
    const vec3& n = vertex.normal;
    text += "vn " + number(n.x) + ' ' + number(n.y) + ' ' + number(n.z) + '\n';
  }
  for (size_t p = 0; p < geometry.parts.size(); ++p) {
    const MeshPart& part = geometry.parts[p];
    text += "g part" + QByteArray::number(static_cast<qulonglong>(p)) + "\nusemtl " +
            materialName(static_cast<size_t>(part.material)) + '\n';
    for (std::uint32_t i = 0; i + 2 < part.indexCount; i += 3) {
      text += 'f';
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const QByteArray index = QByteArray::number(geometry.indices[part.firstIndex + i + corner] + 1);
        text += ' ' + index + '/' + index + '/' + index;
      }
      text += '\n';
    }
  }
  return text;
}

QByteArray mtlText(const PlantGeometry& geometry, const QStringList& pictures) {
  QByteArray text = "# Windfall\n";
  for (size_t i = 0; i < geometry.materials.size(); ++i) {
    const Material& material = geometry.materials[i];
    const vec4& colour = material.baseColor;
    text += commentOf(material.name) + "newmtl " + materialName(i) + "\nKd " + number(encoded(colour.x)) + ' ' +
            number(encoded(colour.y)) + ' ' + number(encoded(colour.z)) + "\nd " + number(colour.w) + '\n';
    const QByteArray picture = pictures.value(static_cast<qsizetype>(i)).toUtf8();
    if (picture.isEmpty()) continue;
    text += "map_Kd " + picture + '\n';
    if (material.texture.hasAlphaChannel()) text += "map_d -imfchan m " + picture + '\n';
  }
  return text;
}

std::vector<ExportParameter> ObjExporter::parameters() const {
  std::vector<ExportParameter> own;
  for (const ExportParameter& parameter : plantExportParameters()) {
    if (QStringList{"detail", "leaves", "leafMesh"}.contains(parameter.key)) own.push_back(parameter);
  }
  return own;
}

namespace {

/// Leaves as mesh, with a material a picture: OBJ knows no instances.
void mergeLeaves(PlantModel& model) {
  PlantGeometry& geometry = model.geometry;
  const auto firstMaterial = static_cast<int>(geometry.materials.size());
  for (const LeafShape& shape : model.shapes) {
    Material material;
    material.name = shape.name;
    material.baseColor = vec4(1);
    material.texture = shape.image;
    material.leaf = true;
    geometry.materials.push_back(material);
  }
  for (std::size_t s = 0; s < model.shapes.size(); ++s) {
    const LeafShape& shape = model.shapes[s];
    MeshPart part;
    part.firstIndex = static_cast<std::uint32_t>(geometry.indices.size());
    part.material = firstMaterial + static_cast<int>(s);
    for (const PlacedLeaf& leaf : model.leaves) {
      if (leaf.shape != static_cast<int>(s)) continue;
      const auto first = static_cast<std::uint32_t>(geometry.vertices.size());
      for (std::size_t i = 0; i < shape.positions.size(); ++i) {
        Vertex vertex{};
        vertex.position = leaf.position + leaf.rotation * (leaf.size * shape.positions[i]);
        vertex.normal = leaf.rotation * shape.normals[i];
        vertex.uv = shape.uvs[i];
        geometry.vertices.push_back(vertex);
      }
      for (const std::uint32_t index : shape.indices) geometry.indices.push_back(first + index);
    }
    part.indexCount = static_cast<std::uint32_t>(geometry.indices.size()) - part.firstIndex;
    if (part.indexCount > 0) geometry.parts.push_back(part);
  }
}

}  // namespace

Status ObjExporter::write(const Project& project, AssetId asset, const QString& path, const QJsonObject& values,
                          Progress& progress) const {
  Result<PlantExportOptions> options = plantExportOptions(*this, values);
  if (!options) return options.error();
  // OBJ knows one mesh alone.
  if (options->leaves != LeafExport::None) options->leaves = LeafExport::Merged;
  Result<PlantModel> model = modelOf(project, asset, *options, progress);
  if (!model) return model.error();
  if (progress.cancelled()) return Error{"cancelled", true};
  mergeLeaves(*model);
  const PlantGeometry* geometry = &model->geometry;

  // The .obj comes last: where it stands, all that it names does too.
  const QFileInfo target(path);
  const QString stem = target.completeBaseName();
  std::vector<std::pair<QString, QByteArray>> files;
  QStringList pictures;
  for (size_t i = 0; i < geometry->materials.size(); ++i) {
    const QImage& texture = geometry->materials[i].texture;
    pictures << (texture.isNull() ? QString() : QStringLiteral("%1_material%2.png").arg(stem).arg(i));
    if (texture.isNull()) continue;
    QByteArray png;
    QBuffer buffer(&png);
    if (!buffer.open(QIODevice::WriteOnly) || !texture.save(&buffer, "png")) return Error{"a PNG cannot be made"};
    files.emplace_back(pictures.back(), png);
  }
  files.emplace_back(stem + QStringLiteral(".mtl"), mtlText(*geometry, pictures));
  files.emplace_back(target.fileName(), objText(*geometry, stem + QStringLiteral(".mtl")));
  for (const auto& [name, bytes] : files) {
    if (const Status written = writeDurably(target.path() + '/' + name, bytes); !written) {
      return Error{(name == target.fileName() ? "" : name.toStdString() + ": ") + written.error().message};
    }
  }
  progress.report(1);
  return ok();
}

}  // namespace windfall::model
