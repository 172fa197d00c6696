#include "app/cli/leaf_settings.h"

#include <QJsonObject>
#include <QStringList>

#include "model/presets/preset.h"

namespace windfall::app {

namespace {

struct Assignment {
  QStringList path;
  QJsonValue value;
};

Assignment parse(const std::string& text) {
  const QString whole = QString::fromStdString(text);
  const qsizetype equals = whole.indexOf('=');
  Assignment result;
  if (equals <= 0) return result;
  const QString value = whole.mid(equals + 1).trimmed();
  bool number = false;
  const double parsed = value.toDouble(&number);
  if (number) result.value = parsed;
  if (value == QLatin1String("true") || value == QLatin1String("false")) {
    result.value = value == QLatin1String("true");
  }
  result.path = whole.left(equals).trimmed().split('.');
  return result;
}

/// The names that a project file knows; a preset leaves out what belongs to a single leaf.
bool isKnown(const QStringList& path) {
  if (path == QStringList{"ageing", "age"} || path == QStringList{"veins", "seed"}) return true;
  QJsonValue at = model::makePreset(QStringLiteral("all"), model::LeafParameters()).values;
  for (const QString& name : path) at = at.isObject() ? at[name] : QJsonValue(QJsonValue::Undefined);
  return !at.isUndefined() && !at.isObject();
}

}  // namespace

std::string wrongAssignment(const std::string& value) {
  const Assignment assignment = parse(value);
  if (assignment.path.isEmpty() || assignment.value.isNull()) {
    return "must be NAME=VALUE, as veins.laterals=6 or shape.vary=true";
  }
  return isKnown(assignment.path) ? std::string() : "no number of a leaf is called so: " + value;
}

Status setParameters(const std::vector<std::string>& assignments, model::LeafParameters& parameters) {
  for (const std::string& text : assignments) {
    const Assignment assignment = parse(text);
    QJsonObject values;
    if (assignment.path.size() == 1) {
      values[assignment.path[0]] = assignment.value;
    } else if (assignment.path.size() == 2) {
      // A seed is kept as text, as numbers of JSON do not reach so far.
      const QJsonValue value = assignment.path[1] == QLatin1String("seed") && assignment.value.isDouble()
                                   ? QJsonValue(QString::number(assignment.value.toDouble(), 'f', 0))
                                   : assignment.value;
      values[assignment.path[0]] = QJsonObject{{assignment.path[1], value}};
    }
    const model::Preset preset{QStringLiteral("leaf"), QStringLiteral("set"), values, {}};
    if (const Status applied = model::applyPreset(preset, parameters); !applied) return applied;
  }
  return ok();
}

}  // namespace windfall::app
