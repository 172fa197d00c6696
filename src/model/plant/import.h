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
  /// `surface` matters to formats that hold a skeleton alone.
  virtual Result<PlantGeometry> read(const SourceFile& file, const SurfaceSettings& surface,
                                     Progress& progress) const = 0;
};

const std::vector<std::unique_ptr<PlantImporter>>& plantImporters();
/// "*.fbx *.glb …" for file dialogs.
QStringList plantFilePatterns();

/// Whether edits by hand work on it: plants of the growers but the plain rule, and files that hold a skeleton alone.
bool canBeShaped(const Plant& plant);

/// Reads the plant's file, or grows it, with what was shaped by hand.
Result<PlantGeometry> loadGeometry(const Plant& plant, Progress& progress);

}  // namespace windfall::model
