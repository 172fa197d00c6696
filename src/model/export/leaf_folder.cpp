#include "model/export/leaf_folder.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QImageReader>
#include <QJsonArray>
#include <QJsonDocument>
#include <QPainter>
#include <QTemporaryDir>
#include <cmath>

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

QByteArray timingsText(const LeafFolder& leaf) {
  QJsonObject stages;
  double total = 0;
  for (const auto& [name, seconds] : leaf.stages->seconds) {
    stages[name] = seconds;
    total += seconds;
  }
  QJsonArray variants;
  for (size_t i = 0; i < leaf.variants.size(); ++i) {
    variants.append(QJsonObject{{"seed", QString::number(leaf.seeds[i])}, {"seconds", leaf.variantSeconds[i]}});
    total += leaf.variantSeconds[i];
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
  QFile file(folder.filePath(name));
  if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size() || !file.flush()) {
    return Error{name.toStdString() + ": " + file.errorString().toStdString()};
  }
  return ok();
}

/// By the name's ending; what is only to be looked at is a JPEG, which takes a tenth of a PNG's time.
Status write(const QDir& folder, const QString& name, const QImage& image) {
  return image.save(folder.filePath(name), nullptr, name.endsWith(QLatin1String(".jpg")) ? 90 : -1)
             ? ok()
             : Status(Error{name.toStdString() + ": it cannot be written"});
}

QString variantName(size_t i) { return QStringLiteral("variant_%1.png").arg(i, 3, 10, QLatin1Char('0')); }

Status writeAll(const LeafFolder& leaf, const QDir& folder, Progress& progress) {
  const LeafStages& stages = *leaf.stages;
  const QByteArray contour = contourText(stages, leaf.bladeLength), veins = veinsText(stages);
  const std::pair<const char*, QByteArray> texts[] = {
      {"contour.json", contour}, {"veins.json", veins}, {"timings.json", timingsText(leaf)}};
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
  for (size_t i = 0; i < leaf.variants.size(); ++i) images.emplace_back(variantName(i), leaf.variants[i]);
  if (!leaf.compare.isNull()) images.emplace_back("compare.png", leaf.compare);
  for (size_t i = 0; i < images.size(); ++i) {
    if (progress.cancelled()) return Error{"cancelled", true};
    if (Status s = write(folder, images[i].first, images[i].second); !s) return s;
    progress.report(static_cast<double>(i + 1) / static_cast<double>(images.size()));
  }
  return ok();
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
  for (const QString& old : place.entryList({QStringLiteral("variant_???.png")}, QDir::Files)) {
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
  QFile file(folder.filePath(QStringLiteral("contour.json")));
  if (!file.open(QIODevice::ReadOnly)) return Error{"no contour.json in it: windfall leaf has not written this folder"};
  if (file.size() > kMostJson) return Error{"contour.json: too large"};
  QJsonParseError parsing;
  const QJsonObject contour = QJsonDocument::fromJson(file.readAll(), &parsing).object();
  if (parsing.error != QJsonParseError::NoError) {
    return Error{"contour.json: " + parsing.errorString().toStdString()};
  }
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
  std::vector<LeafTexture> textures;
  for (const QString& name : folder.entryList({QStringLiteral("variant_???.png")}, QDir::Files, QDir::Name)) {
    QImageReader reader(folder.filePath(name));
    const QImage image = reader.read().convertToFormat(QImage::Format_RGBA8888);
    if (image.isNull()) return Error{name.toStdString() + ": " + reader.errorString().toStdString()};
    const double scale = image.width() / frameWidth;
    textures.push_back(uprightTexture(QFileInfo(name).completeBaseName(), image, (*root - corner) * scale,
                                      (*tip - corner) * scale, bladeLength));
  }
  if (textures.empty()) return Error{"no variant_000.png in it"};
  return textures;
}

}  // namespace windfall::model
