// The volume that a crown fills, and points spread in it (growers.md, 1.1).
#pragma once

#include <memory>
#include <vector>

#include "model/plant/grow/grown.h"
#include "model/plant/grow/settings.h"
#include "model/progress.h"
#include "model/source_file.h"
#include "sim/result.h"

namespace windfall::model::growth {

/// A closed triangle mesh that points can be inside of.
class ClosedMesh {
 public:
  ClosedMesh(std::vector<dvec3> vertices, std::vector<int> triangles);
  /// By the parity of rays along three axes, two of three: survives small holes.
  bool contains(dvec3 point) const;
  dvec3 lower() const { return lower_; }
  dvec3 upper() const { return upper_; }

 private:
  bool oddAlong(int axis, dvec3 point) const;

  std::vector<dvec3> vertices_;
  std::vector<int> triangles_;
  dvec3 lower_{0}, upper_{0};
  /// Triangles by the cells that they cover, seen along each axis.
  static constexpr int kCells = 32;
  std::vector<std::vector<int>> cells_[3];
};

/// Reads all meshes of a file (OBJ, STL, PLY, FBX, glTF) as one closed surface in metres, Y up.
Result<ClosedMesh> readCrownMesh(const SourceFile& file, Progress& progress);

/// Radius in shares of CrownSettings::radius at a share of the crown's height, to the right or the left.
double crownRadius(const CrownSettings& crown, double share, bool left = false);

/// `height` is the tree's; `mesh` takes the place of the outline where it is not empty. Errors: an outline without
/// area, a mesh that is too thin or not closed, numbers that make no crown.
Result<std::vector<dvec3>> crownPoints(const ColonizationSettings& settings, const SourceFile& mesh, double height,
                                       quint64 seed, Progress& progress);

}  // namespace windfall::model::growth
