// Everything that a project file keeps.
#pragma once

#include <QByteArray>
#include <QJsonObject>
#include <vector>

#include "model/leaf/atlas_settings.h"
#include "model/leaf/leaf.h"
#include "model/plant/plant.h"
#include "model/scene/scene.h"

namespace windfall::model {

/// The simulation where it was stopped; bytes of sim::Engine::save. Empty: at the start.
struct SimulationState {
  double time = 0;  ///< s
  QByteArray bytes;
  bool operator==(const SimulationState&) const = default;
};

/// Orbit camera of the viewport.
struct Camera {
  QVector3D target{0, 4, 0};  ///< m
  double azimuth = 35;        ///< degrees about the vertical
  double elevation = 8;       ///< degrees
  double distance = 16;       ///< m
  double fieldOfView = 40;    ///< degrees, vertical
  bool operator==(const Camera&) const = default;
};

/// Saved with the project but never a reason to call it modified.
struct ViewState {
  QString workspace = QStringLiteral("scene");
  Camera camera;
  QJsonObject layout;  ///< window geometry and docks by workspace, image panes' zoom
  bool operator==(const ViewState&) const = default;
};

struct Project {
  std::vector<Leaf> leaves;
  std::vector<Plant> plants;
  Scene scene;
  AtlasSettings atlas;
  SimulationState simulation;
  ViewState view;
  quint64 nextId = 1;

  Leaf* leaf(AssetId id);
  const Leaf* leaf(AssetId id) const;
  Plant* plant(AssetId id);
  const Plant* plant(AssetId id) const;
  TreePlacement* tree(AssetId id);
  const TreePlacement* tree(AssetId id) const;
  bool operator==(const Project&) const = default;
};

}  // namespace windfall::model
