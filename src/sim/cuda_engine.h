// The engine with the trees on a CUDA device; wind and leaves stay on the CPU.
#pragma once

#include <memory>
#include <string>

#include "sim/engine.h"

namespace windfall::sim {

/// Name of the device that would be used; empty where there is none, or where the program was built without CUDA.
std::string cudaDeviceName();

/// Null, with one line in `problem`, where there is no device that works. The scene has been checked.
std::unique_ptr<Engine> makeCudaEngine(const SceneDescription& scene, int threads, std::string& problem);

}  // namespace windfall::sim
