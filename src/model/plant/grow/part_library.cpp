#include "model/plant/grow/part_library.h"

#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QStandardPaths>
#include <algorithm>
#include <cmath>

#include "model/document/durable_file.h"
#include "model/plant/frames.h"

namespace windfall::model {

namespace {

constexpr qsizetype kMostNodes = 100'000;
constexpr qint64 kLargestFile = 32 << 20;

}  // namespace

PlantPart partOf(const std::vector<Bone>& bones, std::size_t first, const QString& name) {
  PlantPart part;
  part.name = name;
  if (first >= bones.size()) return part;
  const vec3 origin = bones[first].head;
  // alongZ turns z to the branch; a part stands along y.
  const quat back = glm::angleAxis(-1.57079633f, vec3(1, 0, 0)) * glm::conjugate(alongZ(bones[first].tail - origin));
  std::vector<int> node(bones.size(), -1);
  part.nodes.push_back({{0, 0, 0}, -1, static_cast<double>(bones[first].radius)});
  for (std::size_t b = first; b < bones.size(); ++b) {
    const int parent = b == first ? 0 : bones[b].parent >= 0 ? node[static_cast<std::size_t>(bones[b].parent)] : -1;
    if (parent < 0) continue;
    const vec3 place = back * (bones[b].tail - origin);
    node[b] = static_cast<int>(part.nodes.size());
    part.nodes.push_back({{place.x, place.y, place.z}, parent, static_cast<double>(bones[b].radius)});
  }
  return part;
}

QByteArray partToJson(const PlantPart& part) {
  QJsonArray nodes;
  for (const PartNode& node : part.nodes) {
    nodes.append(QJsonArray{static_cast<double>(node.position.x()), static_cast<double>(node.position.y()),
                            static_cast<double>(node.position.z()), node.radius, node.parent});
  }
  return QJsonDocument(QJsonObject{{QStringLiteral("version"), 1},
                                   {QStringLiteral("name"), part.name},
                                   {QStringLiteral("nodes"), nodes}})
      .toJson();
}

Result<PlantPart> partFromJson(const QByteArray& json) {
  QJsonParseError parsing;
  const QJsonObject object = QJsonDocument::fromJson(json, &parsing).object();
  if (parsing.error != QJsonParseError::NoError) return Error{parsing.errorString().toStdString()};
  if (object[QStringLiteral("version")].toInt() != 1) return Error{"version: is not 1"};
  PlantPart part;
  part.name = object[QStringLiteral("name")].toString().simplified();
  if (part.name.isEmpty() || part.name.size() > 100) return Error{"name: is missing or too long"};
  const QJsonArray nodes = object[QStringLiteral("nodes")].toArray();
  if (nodes.size() < 2 || nodes.size() > kMostNodes) return Error{"nodes: there must be 2 to 100,000"};
  for (qsizetype i = 0; i < nodes.size(); ++i) {
    const QJsonArray row = nodes[i].toArray();
    double value[4];
    for (int k = 0; k < 4; ++k) value[k] = row.at(k).toDouble(std::nan(""));
    const int parent = row.at(4).toInt(-2);
    const bool good = std::all_of(std::begin(value), std::end(value), [](double v) { return std::abs(v) <= 1000; }) &&
                      value[3] >= 0 && parent < i && parent >= (i == 0 ? -1 : 0);
    if (!good) return Error{"nodes[" + std::to_string(i) + "]: is no node"};
    part.nodes.push_back(
        {{static_cast<float>(value[0]), static_cast<float>(value[1]), static_cast<float>(value[2])}, parent, value[3]});
  }
  return part;
}

PartLibrary::PartLibrary(const QString& folder)
    : folder_(!folder.isEmpty()
                  ? folder
                  : QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + QStringLiteral("/parts")) {
  const QDir directory(folder_);
  for (const QString& name : directory.entryList({QStringLiteral("*.json")}, QDir::Files, QDir::Name)) {
    QFile file(directory.filePath(name));
    if (!file.open(QIODevice::ReadOnly) || file.size() > kLargestFile) continue;
    Result<PlantPart> part = partFromJson(file.readAll());
    if (!part) continue;
    part->file = file.fileName();
    parts_.push_back(std::move(*part));
  }
}

Status PartLibrary::save(PlantPart part) {
  part.name = part.name.simplified();
  const Result<PlantPart> good = partFromJson(partToJson(part));
  if (!good) return good.error();
  if (!QDir().mkpath(folder_)) return Error{"the folder " + folder_.toStdString() + " cannot be made"};
  const QByteArray hash = QCryptographicHash::hash(part.name.toUtf8(), QCryptographicHash::Sha1).toHex().left(16);
  part.file = QDir(folder_).filePath(QStringLiteral("part-%1.json").arg(QString::fromLatin1(hash)));
  if (const Status written = writeDurably(part.file, partToJson(part)); !written) return written;
  std::erase_if(parts_, [&](const PlantPart& other) { return other.name == part.name; });
  parts_.push_back(std::move(part));
  return ok();
}

Status PartLibrary::remove(const QString& name) {
  const auto found =
      std::find_if(parts_.begin(), parts_.end(), [&](const PlantPart& part) { return part.name == name; });
  if (found == parts_.end()) return Error{"there is no such part"};
  if (!QFile::remove(found->file)) return Error{found->file.toStdString() + ": cannot be removed"};
  parts_.erase(found);
  return ok();
}

}  // namespace windfall::model
