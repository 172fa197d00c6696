#include "model/document/upgrade.h"

#include <QJsonArray>
#include <cmath>
#include <iterator>

#include "model/document/project_file.h"

namespace windfall::model {

namespace {

/// Schema 0: leaves stood in a plain array, their length in centimetres.
QJsonObject fromZero(QJsonObject document) {
  QJsonArray items;
  const QJsonArray old = document[QStringLiteral("leaves")].toArray();
  for (const auto& value : old) {
    QJsonObject leaf = value.toObject();
    const QString length = QStringLiteral("lengthInCentimetres");
    if (leaf[length].isDouble()) leaf[QStringLiteral("bladeLength")] = leaf.take(length).toDouble() / 100;
    items.append(leaf);
  }
  document[QStringLiteral("leaves")] = QJsonObject{{QStringLiteral("version"), 1}, {QStringLiteral("leaves"), items}};
  return document;
}

using Upgrade = QJsonObject (*)(QJsonObject);
/// Entry n leads from schema n to n + 1.
constexpr Upgrade kUpgrades[] = {fromZero};
static_assert(std::size(kUpgrades) == schemaVersion, "each older schema needs its upgrade");

}  // namespace

Result<QJsonObject> upgradeSchema(QJsonObject document) {
  const QString key = QStringLiteral("schema");
  const QJsonValue value = document[key];
  const double number = value.toDouble(-1);
  if (!value.isDouble() || number < 0 || number > 1e9 || number != std::floor(number)) {
    return Error{"schema: is missing or not a version number"};
  }
  if (number > schemaVersion) {
    return Error{QStringLiteral("was written by a newer Windfall (schema %1; this one reads up to %2)")
                     .arg(value.toInteger())
                     .arg(schemaVersion)
                     .toStdString()};
  }
  for (int schema = static_cast<int>(number); schema < schemaVersion; ++schema) {
    document = kUpgrades[schema](std::move(document));
    document[key] = schema + 1;
  }
  return document;
}

}  // namespace windfall::model
