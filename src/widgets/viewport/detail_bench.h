// The flight through fifty plants, after Grossfurtner 2023: his uniform mesh, a mesh with counts by an error bound, and
// the adaptive one (plant_meshing.md, 6.6).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/result.h"

namespace windfall::widgets {

struct DetailBenchOptions {
  int width = 1280, height = 720;
  int frames = 4;  ///< of each path
  int rounds = 3;  ///< each frame counts with its shortest time
  int plants = 50;
  std::string pictures;  ///< folder for the frames; empty: none are kept
};

/// One mesh on one path.
struct DetailBenchRow {
  std::string path, mesh;
  double mean = 0, worst = 0;          ///< ms a frame
  double vertices = 0, triangles = 0;  ///< a frame, mean
  double bark = 1;                     ///< pixels with bark, of those of the uniform mesh
  /// Mean of the frames against those of the uniform mesh, with 16 samples a pixel: with the window's four, twigs far
  /// thinner than a pixel are dots that a tenth of a pixel moves.
  double ssim = 1;
  double windowSsim = 1;  ///< with the window's samples
};

/// Draws both paths with all three meshes in turns; `say` gets a line for each path. One clear line where there is no
/// OpenGL 4.5.
Result<std::vector<DetailBenchRow>> benchDetail(const DetailBenchOptions& options,
                                                const std::function<void(const std::string&)>& say);

std::string detailJson(const DetailBenchRow& row);

}  // namespace windfall::widgets
