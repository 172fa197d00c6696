// A plant asset: where its shape comes from, and what the artist changed about its branches.
#pragma once

#include <QString>
#include <map>
#include <optional>
#include <vector>

#include "model/ids.h"
#include "model/plant/clip.h"
#include "model/plant/grow/hand_edit.h"
#include "model/plant/grow/settings.h"
#include "model/plant/surface_settings.h"
#include "model/source_file.h"

namespace windfall::model {

/// Settings of the built-in growers. What one method does not use is kept for the others.
struct GrowerSettings {
  quint64 seed = 1;
  double height = 8;         ///< m
  double baseRadius = 0.11;  ///< m
  int limbs = 26;
  int levels = 3;      ///< trunk, limbs, twigs
  double spread = 55;  ///< degrees between a limb and the trunk
  GrowMethod method = GrowMethod::Rule;
  double age = 60;       ///< years
  double maturity = 60;  ///< years until the plant is full-grown
  ColonizationSettings colonization;
  SelfOrganizingSettings selfOrganizing;
  LSystemSettings lSystem;
  FoliageSettings foliage;
  WoodSettings wood;
  bool operator==(const GrowerSettings&) const = default;
};

/// What can be tuned about a link; multipliers are 1 by default.
struct LinkAttributes {
  double stiffness = 1, damping = 1, windResponse = 1;
  double woodDensity = 950;    ///< kg/m3
  double youngsModulus = 6e9;  ///< Pa
  double rayleighAlpha = 0;    ///< 1/s, damping by mass, beside what `damping` scales
  double rayleighBeta = 0;     ///< s, damping by stiffness, beside what `damping` scales
  double propagation = 0.8;    ///< of the forces method: share of a child's bending that reaches its parent, 0..1
  bool pinned = false;         ///< stands still, with all that carries it
  bool operator==(const LinkAttributes&) const = default;
};

struct Plant {
  AssetId id;
  QString name;
  SourceFile file;                          ///< empty: grown
  std::optional<GrowerSettings> grower;     ///< set when there is no file
  std::map<QString, LinkAttributes> edits;  ///< by bone name; what is absent has defaults
  std::vector<AssetId> leaves;              ///< leaf assets whose kept variants hang on it
  double leafDensity = 1;                   ///< leaves on the tree, share of the natural number
  std::vector<Clip> clips;                  ///< baked motions; those of the file are with its geometry
  SurfaceSettings surface;
  SourceFile crown;                 ///< a closed mesh that the crown fills instead of its outline; metres
  std::vector<HandEdit> handEdits;  ///< what was pruned, bent and drawn, in that order
  bool operator==(const Plant&) const = default;
};

}  // namespace windfall::model
