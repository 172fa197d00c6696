// Named settings: what Windfall brings, and what the artist keeps.
#pragma once

#include <QJsonObject>
#include <QString>
#include <optional>
#include <vector>

#include "model/leaf/leaf.h"
#include "model/plant/plant.h"
#include "sim/result.h"
#include "sim/settings.h"

namespace windfall::model {

/// `domain`: "wind", "leaf" (a species: contour, veins, synthesis, maps, ageing) or "grower". Values are the fields of
/// that domain as in project.json; what is absent stays as it is when the preset is applied.
struct Preset {
  QString domain;
  QString name;
  QJsonObject values;
  QString file;  ///< where it is kept; empty: built in
  bool operator==(const Preset&) const = default;
};

/// Sets the fields that the preset has. "speed: is 999, expected 0 to 200" for nonsense; then nothing changes.
Status applyPreset(const Preset& preset, sim::WindSettings& wind);
Status applyPreset(const Preset& preset, LeafParameters& leaf);
Status applyPreset(const Preset& preset, GrowerSettings& grower);

/// Takes all fields but the seed: two artists' presets should not make the same tree.
Preset makePreset(const QString& name, const sim::WindSettings& wind);
Preset makePreset(const QString& name, const LeafParameters& leaf);
Preset makePreset(const QString& name, const GrowerSettings& grower);

/// One preset as JSON text, and back.
QByteArray presetToJson(const Preset& preset);
Result<Preset> presetFromJson(const QByteArray& json);
/// One that somebody shared. Errors without the file's name.
Result<Preset> readPreset(const QString& path);

/// The built-in ones, then those of a folder (one .json file each).
class PresetLibrary {
 public:
  /// `folder`: the artist's own; default: the application's data. Damaged files are left out and named by `problems`.
  explicit PresetLibrary(const QString& folder = {});

  std::vector<Preset> of(const QString& domain) const;
  /// The artist's own goes before a built-in one of the same name.
  std::optional<Preset> find(const QString& domain, const QString& name) const;
  const std::vector<QString>& problems() const { return problems_; }

  /// Writes it into the folder, over the artist's own one of the same name.
  Status save(Preset preset);
  /// Takes one that somebody shared; it must be of `domain`. The preset, as it is kept now.
  Result<Preset> import(const QString& path, const QString& domain);
  /// Built-in ones can't be removed.
  Status remove(const QString& domain, const QString& name);

 private:
  QString folder_;
  std::vector<Preset> presets_;
  std::vector<QString> problems_;
};

}  // namespace windfall::model
