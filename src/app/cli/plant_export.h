// `windfall plant FILE -o OUT`: a plant written in another format.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

namespace windfall::app {

struct PlantExportCli {
  double detail = -1;
  int bones = 0, depth = 0, levels = 1, primVersion = 0;
  std::string leaves = "merged", leafMesh = "automatic", chains = "score", bark, plant;
};

/// Declares --detail, --bones, --depth, --leaves, --leaf-mesh, --levels, --prim-version, --chains, --bark and --plant.
std::shared_ptr<PlantExportCli> declarePlantExport(CLI::App& command);

/// Writes `file` (a plant or a project) to `output` (.glb, .gltf, .obj, .prim, .json); the process's exit status.
int exportPlant(const std::string& file, const std::string& output, const PlantExportCli& options);

}  // namespace windfall::app
