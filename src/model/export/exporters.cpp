#include "model/export/atlas_exporter.h"
#include "model/export/exporter.h"
#include "model/export/gltf_exporter.h"
#include "model/export/obj_exporter.h"

namespace windfall::model {

const std::vector<std::unique_ptr<Exporter>>& exporters() {
  static const std::vector<std::unique_ptr<Exporter>> all = [] {
    std::vector<std::unique_ptr<Exporter>> made;
    made.push_back(std::make_unique<AtlasExporter>());
    made.push_back(std::make_unique<GltfExporter>());
    made.push_back(std::make_unique<ObjExporter>());
    return made;
  }();
  return all;
}

const Exporter* findExporter(const QString& id) {
  for (const auto& exporter : exporters()) {
    if (exporter->id() == id) return exporter.get();
  }
  return nullptr;
}

Result<double> parameterValue(const Exporter& exporter, const QJsonObject& values, const QString& key) {
  for (const ExportParameter& parameter : exporter.parameters()) {
    if (parameter.key != key) continue;
    if (!values.contains(key)) return parameter.initial;
    const QJsonValue value = values.value(key);
    const double number = value.toDouble();
    if (!value.isDouble() || !(number >= parameter.low && number <= parameter.high) ||
        (parameter.whole && number != static_cast<double>(static_cast<qint64>(number)))) {
      return Error{QStringLiteral("%1: expected %2 from %3 to %4")
                       .arg(key, parameter.whole ? QStringLiteral("a whole number") : QStringLiteral("a number"))
                       .arg(parameter.low)
                       .arg(parameter.high)
                       .toStdString()};
    }
    return number;
  }
  return Error{key.toStdString() + ": is no parameter of " + exporter.id().toStdString()};
}

}  // namespace windfall::model
