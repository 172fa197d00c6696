#include "model/export/leaf_folder.h"

#include <QBuffer>
#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QFileInfo>
#include <QImageReader>
#include <QJsonArray>
#include <QJsonDocument>
#include <QPainter>
#include <QTemporaryDir>
#include <algorithm>
#include <cmath>

#include "model/export/kept_textures.h"
#include "model/export/write_together.h"
#include "model/leaf/superpixel_pyramid.h"
#include "model/leaf/vein_growth.h"

namespace windfall::model {

namespace {

constexpr qint64 kMostJson = 64 << 20;  // bytes
constexpr int kLevels = 5;              // of superpixels

/// Hundredths of a pixel are more than a photo knows.
double rounded(double value) { return std::round(value * 100) / 100; }

QJsonArray json(QPointF p) { return {rounded(p.x()), rounded(p.y())}; }

QJsonArray json(const std::vector<QPointF>& points) {
  QJsonArray array;
  for (const QPointF& p : points) array.append(json(p));
  return array;
}

QByteArray contourText(const LeafStages& stages, double bladeLength) {
  return QJsonDocument(QJsonObject{{"photo", QJsonArray{stages.photo.width(), stages.photo.height()}},
                                   {"frame", QJsonArray{stages.frame.x(), stages.frame.y(), stages.frame.width(),
                                                        stages.frame.height()}},
                                   {"root", json(stages.root)},
                                   {"tip", json(stages.tip)},
                                   {"petiole", json(stages.petiole)},
                                   {"bladeLength", bladeLength},
                                   {"borderPixels", static_cast<qint64>(stages.border.size())},
                                   {"points", json(stages.contour)}})
      .toJson();
}

QByteArray veinsText(const LeafStages& stages) {
  QJsonArray veins;
  for (const Vein& vein : stages.veins) {
    veins.append(QJsonObject{{"order", vein.order},
                             {"parent", vein.parent},
                             {"startWidth", rounded(vein.startWidth)},
                             {"endWidth", rounded(vein.endWidth)},
                             {"points", json(vein.points)}});
  }
  return QJsonDocument(
             QJsonObject{{"photo", QJsonArray{stages.photo.width(), stages.photo.height()}}, {"veins", veins}})
      .toJson();
}

/// Seconds that the maps and the mesh of a variant took.
struct DressSeconds {
  double maps = 0, mesh = 0;
};

QByteArray timingsText(const LeafFolder& leaf, const std::vector<DressSeconds>& dressed) {
  QJsonObject stages;
  double total = 0;
  for (const auto* named : {&leaf.stages->seconds, &leaf.otherSeconds}) {
    for (const auto& [name, seconds] : *named) {
      stages[name] = seconds;
      total += seconds;
    }
  }
  QJsonArray variants;
  for (size_t i = 0; i < leaf.variants.size(); ++i) {
    const double maps = i < dressed.size() ? dressed[i].maps : 0, mesh = i < dressed.size() ? dressed[i].mesh : 0;
    variants.append(QJsonObject{
        {"seed", QString::number(leaf.seeds[i])}, {"seconds", leaf.variantSeconds[i]}, {"maps", maps}, {"mesh", mesh}});
    total += leaf.variantSeconds[i] + maps + mesh;
  }
  return QJsonDocument(QJsonObject{{"stages", stages}, {"variants", variants}, {"total", total}}).toJson();
}

QImage distanceImage(const ScalarField& field) {
  QImage image(field.size, QImage::Format_Grayscale16);
  size_t i = 0;
  for (int y = 0; y < image.height(); ++y) {
    auto* row = reinterpret_cast<quint16*>(image.scanLine(y));
    for (int x = 0; x < image.width(); ++x, ++i) {
      row[x] = static_cast<quint16>(std::lround(65535 * std::clamp(field.values[i], 0.0f, 1.0f)));
    }
  }
  return image;
}

QImage over(const QImage& photo, const QImage& picture) {
  QImage image = photo.convertToFormat(QImage::Format_RGB32);
  QPainter painter(&image);
  painter.drawImage(image.rect(), picture);
  return image;
}

Status write(const QDir& folder, const QString& name, const QByteArray& bytes) {
  const Status written = writeBytes(folder.filePath(name), bytes);
  return written ? ok() : Status(Error{name.toStdString() + ": " + written.error().message});
}

/// A PNG of little compression is written in a fraction of the time and hardly larger.
constexpr int kPngQuality = 70, kJpegQuality = 90;

/// By the name's ending; what is only to be looked at is a JPEG, which takes a tenth of a PNG's time. Encoded first: a
/// picture's writer does not tell when its last bytes find no room.
Status write(const QDir& folder, const QString& name, const QImage& image) {
  const bool jpeg = name.endsWith(QLatin1String(".jpg"));
  QBuffer bytes;
  if (!bytes.open(QIODevice::WriteOnly) ||
      !image.save(&bytes, jpeg ? "JPG" : "PNG", jpeg ? kJpegQuality : kPngQuality)) {
    return Error{name.toStdString() + ": the picture cannot be made"};
  }
  return write(folder, name, bytes.data());
}

QString variantName(size_t i, const char* ending) {
  return QStringLiteral("variant_%1%2").arg(i, 3, 10, QLatin1Char('0')).arg(QLatin1String(ending));
}

/// The levels of a variant's mesh: metres from the petiole's end (x right, y to the tip), and where each corner lies in
/// the variant's picture, in shares from the top left.
QByteArray meshText(const LeafTexture& texture, QSize variant) {
  const double length = texture.metres.height() * std::clamp(texture.pivot.y(), 0.1, 1.0);
  const QTransform back = texture.toTexture.inverted();
  QJsonArray levels;
  for (const LeafMesh& mesh : texture.meshes) {
    QJsonArray positions, uvs, ribs, indices;
    const auto number = [](double value) { return std::round(value * 1e6) / 1e6; };
    for (const LeafVertex& v : mesh.vertices) {
      positions.append(number(static_cast<double>(v.place.x) * length));
      positions.append(number(static_cast<double>(v.place.y) * length));
      ribs.append(number(static_cast<double>(v.rib) * length));
      const QPointF pixel = back.map(QPointF(static_cast<double>(v.uv.x) * texture.image.width(),
                                             static_cast<double>(v.uv.y) * texture.image.height()));
      uvs.append(number(pixel.x() / variant.width()));
      uvs.append(number(pixel.y() / variant.height()));
    }
    for (const std::uint32_t corner : mesh.indices) indices.append(static_cast<qint64>(corner));
    levels.append(QJsonObject{{"triangles", static_cast<qint64>(mesh.indices.size() / 3)},
                              {"positions", positions},
                              {"uvs", uvs},
                              {"fromMidrib", ribs},
                              {"indices", indices}});
  }
  return QJsonDocument(QJsonObject{{"levels", levels}}).toJson(QJsonDocument::Compact);
}

/// A variant, aged as the parameters say, with its maps and mesh.
Status writeVariant(const LeafFolder& leaf, size_t i, const QDir& folder, DressSeconds& seconds) {
  const LeafStages& stages = *leaf.stages;
  const QSize size = leaf.variants[i].size();
  const AgeingParameters& ageing = leaf.parameters.ageing;
  const LeafAge age = leafAge(ageing);
  QElapsedTimer timer;
  timer.start();
  MapSource source{leaf.variants[i], variantVeins(stages, size), stages.toVariant(stages.root, size), leaf.seeds[i],
                   age.dryness(ageing.wetness)};
  if (ageing.age > 0) {
    source.image = agedTexture(source.image, makeMaps(source, leaf.parameters.maps).ageing, age, ageing);
  }
  const LeafMaps maps = makeMaps(source, leaf.parameters.maps);
  seconds.maps = static_cast<double>(timer.nsecsElapsed()) * 1e-9;
  timer.start();
  LeafTexture texture =
      uprightTexture({}, source.image, source.root, stages.toVariant(stages.tip, size), leaf.bladeLength, source.veins);
  Result<LeafMeshes> meshes = fitTexture(texture);
  if (!meshes) return meshes.error();
  texture.meshes = std::move(*meshes);
  seconds.mesh = static_cast<double>(timer.nsecsElapsed()) * 1e-9;
  const std::pair<const char*, const QImage*> images[] = {{".png", &source.image},
                                                          {"_height.png", &maps.height},
                                                          {"_normal.png", &maps.normal},
                                                          {"_roughness.png", &maps.roughness},
                                                          {"_occlusion.png", &maps.occlusion},
                                                          {"_translucency.png", &maps.translucency}};
  for (const auto& [ending, image] : images) {
    if (Status s = write(folder, variantName(i, ending), *image); !s) return s;
  }
  return write(folder, variantName(i, "_mesh.json"), meshText(texture, size));
}

Status writeAll(const LeafFolder& leaf, const QDir& folder, Progress& progress) {
  const LeafStages& stages = *leaf.stages;
  const QByteArray contour = contourText(stages, leaf.bladeLength), veins = veinsText(stages);
  const std::pair<const char*, QByteArray> texts[] = {{"contour.json", contour}, {"veins.json", veins}};
  for (const auto& [name, text] : texts) {
    if (Status s = write(folder, QString::fromLatin1(name), text); !s) return s;
  }
  const std::pair<Stage, const char*> looks[] = {{Stage::Mask, "mask"},       {Stage::Contour, "contour"},
                                                 {Stage::Veins, "veins"},     {Stage::Distance, "distance"},
                                                 {Stage::Regions, "regions"}, {Stage::Superpixels, "superpixels"}};
  std::vector<std::pair<QString, QImage>> images{{"mask.png", stages.mask},
                                                 {"veins.png", drawVeins(stages.veins, stages.photo.size(), {0, 0}, 1)},
                                                 {"distance.png", distanceImage(stages.grown.distance)}};
  for (const auto& [stage, name] : looks) {
    const QImage picture = stagePicture(stages, stage);
    if (stage == Stage::Regions) images.emplace_back("regions.png", picture);
    if (stage == Stage::Superpixels) {
      // The thesis's five levels, from coarse to fine.
      LeafStages level = stages;
      for (int n = 0; n < kLevels; ++n) {
        level.grown.superpixels = superpixelLevel(stages.grown, n, kLevels);
        images.emplace_back(QStringLiteral("superpixels_%1.png").arg(n + 1), stagePicture(level, stage));
      }
    }
    images.emplace_back(QStringLiteral("look_%1.jpg").arg(QString::fromLatin1(name)), over(stages.photo, picture));
  }
  if (!leaf.compare.isNull()) images.emplace_back("compare.png", leaf.compare);
  const double steps = static_cast<double>(images.size() + leaf.variants.size());
  for (size_t i = 0; i < images.size(); ++i) {
    if (progress.cancelled()) return Error{"cancelled", true};
    if (Status s = write(folder, images[i].first, images[i].second); !s) return s;
    progress.report(static_cast<double>(i + 1) / steps);
  }
  std::vector<DressSeconds> dressed(leaf.variants.size());
  for (size_t i = 0; i < leaf.variants.size(); ++i) {
    if (progress.cancelled()) return Error{"cancelled", true};
    if (Status s = writeVariant(leaf, i, folder, dressed[i]); !s) return s;
    progress.report(static_cast<double>(images.size() + i + 1) / steps);
  }
  return write(folder, "timings.json", timingsText(leaf, dressed));
}

/// A .json of the folder; what is wrong begins with its name.
Result<QJsonObject> readJson(const QDir& folder, const QString& name) {
  const auto fails = [&](const QString& what) { return Error{(name + QStringLiteral(": ") + what).toStdString()}; };
  QFile file(folder.filePath(name));
  if (!file.open(QIODevice::ReadOnly)) return fails(file.errorString());
  if (file.size() > kMostJson) return fails(QStringLiteral("too large"));
  QJsonParseError parsing;
  const QJsonObject object = QJsonDocument::fromJson(file.readAll(), &parsing).object();
  if (parsing.error != QJsonParseError::NoError) return fails(parsing.errorString());
  return object;
}

/// Photo pixels; none where the folder has no veins.json.
Result<Veins> readVeins(const QDir& folder) {
  Veins veins;
  const QString name = QStringLiteral("veins.json");
  if (!folder.exists(name)) return veins;
  const Result<QJsonObject> object = readJson(folder, name);
  if (!object) return object.error();
  for (const QJsonValue& value : object->value(QLatin1String("veins")).toArray()) {
    Vein vein{value[QLatin1String("order")].toInt(1),
              value[QLatin1String("parent")].toInt(-1),
              {},
              std::clamp(value[QLatin1String("startWidth")].toDouble(1), 0.0, 1e4),
              std::clamp(value[QLatin1String("endWidth")].toDouble(1), 0.0, 1e4)};
    for (const QJsonValue& point : value[QLatin1String("points")].toArray()) {
      const double x = point[0].toDouble(1e9), y = point[1].toDouble(1e9);
      if (std::abs(x) > 1e6 || std::abs(y) > 1e6) return Error{"veins.json: a point that cannot be"};
      vein.points.emplace_back(x, y);
    }
    if (!vein.points.empty()) veins.push_back(std::move(vein));
  }
  return veins;
}

Result<QPointF> pointOf(const QJsonObject& object, const char* key) {
  const QJsonArray pair = object[QLatin1String(key)].toArray();
  if (pair.size() != 2 || !pair[0].isDouble() || !pair[1].isDouble()) {
    return Error{std::string("contour.json: “") + key + "” is not a point"};
  }
  return QPointF(pair[0].toDouble(), pair[1].toDouble());
}

}  // namespace

Status writeLeafFolder(const LeafFolder& leaf, const QString& path, Progress& progress) {
  const QFileInfo target(path);
  if (target.exists() && !target.isDir()) return Error{"this is a file, not a folder"};
  const QString parent = target.absolutePath();
  if (!QDir().mkpath(parent)) return Error{"the folder cannot be made"};
  QTemporaryDir making(parent + QStringLiteral("/.windfall-leaf-XXXXXX"));
  if (!making.isValid()) return Error{"the folder cannot be written: " + making.errorString().toStdString()};
  const QDir made(making.path());
  if (Status written = writeAll(leaf, made, progress); !written) return written;
  if (!QDir().mkpath(target.absoluteFilePath())) return Error{"the folder cannot be made"};
  const QDir place(target.absoluteFilePath());
  for (const QString& old :
       place.entryList({QStringLiteral("variant_???.png"), QStringLiteral("variant_???_*")}, QDir::Files)) {
    if (!made.exists(old)) QFile::remove(place.filePath(old));
  }
  for (const QString& name : made.entryList(QDir::Files)) {
    const QString to = place.filePath(name);
    if (QFile::exists(to) && !QFile::remove(to)) return Error{name.toStdString() + ": it cannot be replaced"};
    if (!QFile::rename(made.filePath(name), to)) return Error{name.toStdString() + ": it cannot be put in place"};
  }
  return ok();
}

Result<std::vector<LeafTexture>> readLeafFolder(const QString& path) {
  const QDir folder(path);
  if (!folder.exists(QStringLiteral("contour.json"))) {
    return Error{"no contour.json in it: windfall leaf has not written this folder"};
  }
  const Result<QJsonObject> read = readJson(folder, QStringLiteral("contour.json"));
  if (!read) return read.error();
  const QJsonObject& contour = *read;
  const Result<QPointF> root = pointOf(contour, "root"), tip = pointOf(contour, "tip");
  for (const Result<QPointF>* point : {&root, &tip}) {
    if (!*point) return point->error();
  }
  const double bladeLength = contour[QLatin1String("bladeLength")].toDouble();
  const QJsonArray frame = contour[QLatin1String("frame")].toArray();
  const QPointF corner(frame.at(0).toDouble(), frame.at(1).toDouble());
  const double frameWidth = frame.at(2).toDouble();
  if (!(frameWidth >= 1 && bladeLength > 0 && bladeLength < 100)) {
    return Error{"contour.json: sizes that cannot be"};
  }
  const Result<Veins> veins = readVeins(folder);
  if (!veins) return veins.error();
  std::vector<LeafTexture> textures;
  for (const QString& name : folder.entryList({QStringLiteral("variant_???.png")}, QDir::Files, QDir::Name)) {
    QImageReader reader(folder.filePath(name));
    const QImage image = reader.read().convertToFormat(QImage::Format_RGBA8888);
    if (image.isNull()) return Error{name.toStdString() + ": " + reader.errorString().toStdString()};
    const double scale = image.width() / frameWidth;
    Veins own = *veins;
    for (Vein& vein : own) {
      for (QPointF& p : vein.points) p = (p - corner) * scale;
      vein.startWidth *= scale;
      vein.endWidth *= scale;
    }
    LeafTexture texture = uprightTexture(QFileInfo(name).completeBaseName(), image, (*root - corner) * scale,
                                         (*tip - corner) * scale, bladeLength, own);
    if (const Status dressed = dressTexture(texture, {}, textures.size() + 1); !dressed) {
      return Error{name.toStdString() + ": " + dressed.error().message};
    }
    textures.push_back(std::move(texture));
  }
  if (textures.empty()) return Error{"no variant_000.png in it"};
  return textures;
}

}  // namespace windfall::model
