// Readers of plant files. A new format is one new file and one line in import.cpp.
#pragma once

#include <QStringList>
#include <memory>
#include <vector>

#include "model/plant/geometry.h"
#include "model/plant/plant.h"
#include "model/progress.h"
#include "model/source_file.h"
#include "sim/result.h"

namespace windfall::model {

class PlantImporter {
 public:
  virtual ~PlantImporter() = default;
  virtual QString name() const = 0;
  /// Lower case, without the dot.
  virtual QStringList extensions() const = 0;
  /// `surface` and `wood` matter to formats that hold a skeleton alone, and where its surface is made anew.
  virtual Result<PlantGeometry> read(const SourceFile& file, const SurfaceSettings& surface, WoodMesh wood,
                                     Progress& progress) const = 0;
};

const std::vector<std::unique_ptr<PlantImporter>>& plantImporters();
/// "*.fbx *.glb …" for file dialogs.
QStringList plantFilePatterns();

/// Whether edits by hand work on it: plants of the growers but the plain rule, and files that hold a skeleton alone.
bool canBeShaped(const Plant& plant);

/// Reads the plant's file, or grows it, with what was shaped by hand.
Result<PlantGeometry> loadGeometry(const Plant& plant, Progress& progress, WoodMesh wood = WoodMesh::Whole);

}  // namespace windfall::model
