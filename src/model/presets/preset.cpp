#include "model/presets/preset.h"

#include <QJsonDocument>

#include "model/document/project_fields.h"

namespace windfall::model {

namespace {

const QString kWind = QStringLiteral("wind"), kLeaf = QStringLiteral("leaf"), kGrower = QStringLiteral("grower");
constexpr int kVersion = 1;
constexpr qsizetype kLongestName = 100;

template <class Settings>
Status apply(const Preset& preset, const QString& domain, Settings& settings) {
  if (preset.domain != domain) {
    return Error{QStringLiteral("is a preset of “%1”, not of “%2”").arg(preset.domain, domain).toStdString()};
  }
  ReadContext context;
  FieldReader io(context, preset.values, {});
  Settings changed = settings;
  fields(io, changed);
  if (!context.error.isEmpty()) return Error{context.error.toStdString()};
  settings = changed;
  return ok();
}

template <class Settings>
Preset make(const QString& name, const QString& domain, const Settings& settings) {
  WriteContext context;
  FieldWriter io(context, {});
  fields(io, settings);
  QJsonObject values = io.take();
  values.remove(QStringLiteral("seed"));
  return {domain, name, values, {}};
}

}  // namespace

Status applyPreset(const Preset& preset, sim::WindSettings& wind) { return apply(preset, kWind, wind); }
Status applyPreset(const Preset& preset, LeafParameters& leaf) { return apply(preset, kLeaf, leaf); }
Status applyPreset(const Preset& preset, GrowerSettings& grower) { return apply(preset, kGrower, grower); }

Preset makePreset(const QString& name, const sim::WindSettings& wind) {
  Preset preset = make(name, kWind, wind);
  // When the wind ends, what follows a clock, and what stands in the scene belong to it, not to a kind of wind.
  for (const char* own : {"until", "course", "repeat", "curve", "records", "recordName", "fans", "canopyHeight"}) {
    preset.values.remove(QLatin1String(own));
  }
  return preset;
}
Preset makePreset(const QString& name, const LeafParameters& leaf) {
  Preset preset = make(name, kLeaf, leaf);
  QJsonObject veins = preset.values[QStringLiteral("veins")].toObject();
  veins.remove(QStringLiteral("seed"));
  preset.values[QStringLiteral("veins")] = veins;
  // How old the textures are belongs to a leaf, not to a species.
  QJsonObject ageing = preset.values[QStringLiteral("ageing")].toObject();
  ageing.remove(QStringLiteral("age"));
  preset.values[QStringLiteral("ageing")] = ageing;
  return preset;
}
Preset makePreset(const QString& name, const GrowerSettings& grower) { return make(name, kGrower, grower); }

QByteArray presetToJson(const Preset& preset) {
  const QJsonObject object{{QStringLiteral("version"), kVersion},
                           {QStringLiteral("domain"), preset.domain},
                           {QStringLiteral("name"), preset.name},
                           {QStringLiteral("values"), preset.values}};
  return QJsonDocument(object).toJson(QJsonDocument::Indented);
}

Result<Preset> presetFromJson(const QByteArray& json) {
  QJsonParseError parsing;
  const QJsonObject object = QJsonDocument::fromJson(json, &parsing).object();
  if (parsing.error != QJsonParseError::NoError) return Error{parsing.errorString().toStdString()};
  if (object[QStringLiteral("version")].toInt() != kVersion) return Error{"version: is not 1"};
  Preset preset{object[QStringLiteral("domain")].toString(),
                object[QStringLiteral("name")].toString().simplified(),
                object[QStringLiteral("values")].toObject(),
                {}};
  if (preset.name.isEmpty() || preset.name.size() > kLongestName) return Error{"name: is missing or too long"};
  // Tried on defaults, so that a preset that is in the list can be applied.
  sim::WindSettings wind;
  LeafParameters leaf;
  GrowerSettings grower;
  const Status good = preset.domain == kWind     ? applyPreset(preset, wind)
                      : preset.domain == kLeaf   ? applyPreset(preset, leaf)
                      : preset.domain == kGrower ? applyPreset(preset, grower)
                                                 : Status(Error{"domain: is none that Windfall knows"});
  if (!good)
    return Error{(preset.domain == kWind || preset.domain == kLeaf || preset.domain == kGrower ? "values." : "") +
                 good.error().message};
  return preset;
}

}  // namespace windfall::model
