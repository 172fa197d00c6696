// The scene: which trees stand where, the wind, the leaves, the light.
#pragma once

#include <QString>
#include <QVector3D>
#include <vector>

#include "model/ids.h"
#include "sim/settings.h"

namespace windfall::model {

/// A tree of the scene: a plant, placed.
struct TreePlacement {
  AssetId id;
  QString name;
  AssetId plant;
  QVector3D position;  ///< m
  double heading = 0;  ///< degrees about the vertical
  double scale = 1;
  bool operator==(const TreePlacement&) const = default;
};

struct Light {
  double azimuth = 135;   ///< degrees, clockwise from north (-Z)
  double elevation = 38;  ///< degrees above the horizon
  double strength = 1;
  bool operator==(const Light&) const = default;
};

/// How finely trees are drawn.
struct DetailSettings {
  bool adaptive = true;     ///< wood by what is seen of it; else the whole mesh of every tree
  double tolerance = 0.5;   ///< px that adaptive wood may be off
  bool cards = true;        ///< far away, cards stand for clusters of leaves; else every leaf is drawn
  double cardsBelow = 1.5;  ///< px of a leaf's length below which its cluster is a card
  bool operator==(const DetailSettings&) const = default;
};

/// LeafSettings::count of a scene that shows as many leaves as its trees have places for.
inline constexpr std::int32_t kEveryLeaf = -1;

struct Scene {
  std::vector<TreePlacement> trees;
  sim::WindSettings wind;
  sim::LeafSettings leaves{.count = kEveryLeaf};
  sim::SolverSettings solver;
  Light light;
  DetailSettings detail;
  quint64 seed = 1;
  bool operator==(const Scene&) const = default;
};

}  // namespace windfall::model
