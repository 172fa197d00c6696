// What OpenGL the current context is.
#pragma once

#include <string>

#include "sim/result.h"

namespace windfall::render {

/// Fails with one clear line where the current context is not OpenGL 4.5 or later.
Status checkVersion();
/// The device's own name ("llvmpipe (LLVM 15.0.6, 256 bits)").
std::string deviceName();
/// True where the CPU draws: then passes that cost much and show little are made smaller.
bool isSoftware();

}  // namespace windfall::render
