#include "model/document/project_json.h"

#include <QJsonDocument>
#include <algorithm>

#include "model/document/project_fields.h"
#include "model/document/project_file.h"
#include "model/document/upgrade.h"

namespace windfall::model {

namespace {

/// Deeper nesting than any project has.
constexpr int kDeepest = 64;
/// Of a domain's own subtree; a domain may grow without the others.
constexpr int kDomainVersion = 1;
constexpr qsizetype kMostAssets = 100'000;

/// Nesting of objects and lists, without parsing: the parser recurses.
int depthOf(const QByteArray& json) {
  int depth = 0, deepest = 0;
  bool text = false;
  for (qsizetype i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (text) {
      if (c == '\\') ++i;
      if (c == '"') text = false;
    } else if (c == '"') {
      text = true;
    } else if (c == '{' || c == '[') {
      deepest = std::max(deepest, ++depth);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return deepest;
}

template <class Fill>
QJsonObject writeDomain(WriteContext& context, const char* place, Fill fill) {
  FieldWriter io(context, QLatin1String(place));
  io.number("version", kDomainVersion, 1, 1);
  fill(io);
  return io.take();
}

/// Opens a domain's subtree if it is there and not newer than this program.
template <class Fill>
void readDomain(ReadContext& context, const QJsonObject& document, const char* key, const QString& place, Fill fill) {
  const QJsonValue value = document.value(QLatin1String(key));
  FieldReader io(context, value.toObject(), place);
  if (value.isUndefined()) return;
  if (!value.isObject()) return io.fail(QLatin1String(key), QStringLiteral("is not an object"));
  const double version = value[QLatin1String("version")].toDouble(0);
  if (version > kDomainVersion) {
    return io.fail(QLatin1String(key),
                   QStringLiteral("was written by a newer Windfall (version %1; this one reads up to %2)")
                       .arg(version)
                       .arg(kDomainVersion));
  }
  if (version != kDomainVersion) return io.fail(QLatin1String(key), QStringLiteral("has no known version"));
  fill(io);
}

}  // namespace

Result<std::vector<ArchiveEntry>> toEntries(const Project& project) {
  if (const QString wrong = checkProject(project); !wrong.isEmpty()) return Error{wrong.toStdString()};
  WriteContext context;
  context.entries.push_back({QLatin1String(kProjectEntry), {}, false});
  QJsonObject document;
  document[QStringLiteral("schema")] = schemaVersion;
  document[QStringLiteral("nextId")] = static_cast<qint64>(project.nextId);
  // Their list has the domain's name, so that a place reads "leaves[2]".
  document[QStringLiteral("leaves")] =
      writeDomain(context, "", [&](FieldWriter& io) { io.list("leaves", project.leaves, kMostAssets); });
  document[QStringLiteral("atlas")] =
      writeDomain(context, "atlas", [&](FieldWriter& io) { fields(io, project.atlas); });
  document[QStringLiteral("plants")] =
      writeDomain(context, "", [&](FieldWriter& io) { io.list("plants", project.plants, kMostAssets); });
  document[QStringLiteral("scene")] =
      writeDomain(context, "scene", [&](FieldWriter& io) { fields(io, project.scene); });
  document[QStringLiteral("simulation")] =
      writeDomain(context, "simulation", [&](FieldWriter& io) { fields(io, project.simulation); });
  document[QStringLiteral("view")] = writeDomain(context, "view", [&](FieldWriter& io) { fields(io, project.view); });
  if (!context.error.isEmpty()) return Error{context.error.toStdString()};
  context.entries.front().bytes = QJsonDocument(document).toJson(QJsonDocument::Indented);
  return std::move(context.entries);
}
Result<Project> fromJson(const QByteArray& json,
                         const std::function<Result<QByteArray>(const QString& name, qint64 limit)>& entry) {
  const auto wrong = [](const QString& message) { return Error{"project.json: " + message.toStdString()}; };
  if (depthOf(json) > kDeepest) return wrong(QStringLiteral("is nested deeper than %1 levels").arg(kDeepest));
  QJsonParseError parsing;
  const QJsonDocument parsed = QJsonDocument::fromJson(json, &parsing);
  if (parsed.isNull()) {
    const qsizetype line = json.left(parsing.offset).count('\n') + 1;
    return wrong(QStringLiteral("line %1: %2").arg(line).arg(parsing.errorString()));
  }
  if (!parsed.isObject()) return wrong(QStringLiteral("is not an object"));
  Result<QJsonObject> upgraded = upgradeSchema(parsed.object());
  if (!upgraded) return upgraded.error();
  const QJsonObject& document = *upgraded;

  ReadContext context{entry, {}, false};
  Project project;
  FieldReader root(context, document, {});
  AssetId next{1};
  root.id("nextId", next);
  project.nextId = next.value;
  readDomain(context, document, "leaves", {}, [&](FieldReader& io) { io.list("leaves", project.leaves, kMostAssets); });
  readDomain(context, document, "atlas", QStringLiteral("atlas"), [&](FieldReader& io) { fields(io, project.atlas); });
  readDomain(context, document, "plants", {}, [&](FieldReader& io) { io.list("plants", project.plants, kMostAssets); });
  readDomain(context, document, "scene", QStringLiteral("scene"), [&](FieldReader& io) { fields(io, project.scene); });
  readDomain(context, document, "simulation", QStringLiteral("simulation"),
             [&](FieldReader& io) { fields(io, project.simulation); });
  readDomain(context, document, "view", QStringLiteral("view"), [&](FieldReader& io) { fields(io, project.view); });
  if (context.cancelled) return Error{"cancelled", true};
  if (!context.error.isEmpty()) return Error{context.error.toStdString()};
  if (const QString broken = checkProject(project); !broken.isEmpty()) return Error{broken.toStdString()};
  return project;
}

}  // namespace windfall::model
