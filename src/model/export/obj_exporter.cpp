#include "model/export/obj_exporter.h"

#include <QBuffer>
#include <QCoreApplication>
#include <QFileInfo>
#include <cmath>

#include "model/document/durable_file.h"
#include "model/plant/import.h"
#include "model/progress_part.h"

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

Status ObjExporter::write(const Project& project, AssetId asset, const QString& path, const QJsonObject&,
                          Progress& progress) const {
  const Plant* plant = project.plant(asset);
  if (!plant) return Error{"there is no such plant"};
  ProgressPart loading(progress, 0, 0.6);
  const Result<PlantGeometry> geometry = loadGeometry(*plant, loading);
  if (!geometry)
    return Error{"plant “" + plant->name.toStdString() + "”: " + geometry.error().message, geometry.error().cancelled};
  if (progress.cancelled()) return Error{"cancelled", true};

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
