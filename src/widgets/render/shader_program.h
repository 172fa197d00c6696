// Compiles the embedded shaders.
#pragma once

#include <string>
#include <vector>

#include "sim/result.h"
#include "widgets/render/gl_object.h"

namespace windfall::render {

/// Links a vertex shader, and a fragment shader unless its name is empty, of resources/shaders. `defines` become
/// "#define X" lines; `#include "file"` lines are replaced by the file. The error names file and line.
Result<Program> linkProgram(const std::string& vertex, const std::string& fragment,
                            const std::vector<std::string>& defines = {});

/// Links a compute shader.
Result<Program> linkCompute(const std::string& name, const std::vector<std::string>& defines = {});

/// The same from a text of its own; `name` stands for it in errors.
Result<Shader> compileShader(GLenum stage, const std::string& name, const std::string& text,
                             const std::vector<std::string>& defines);

}  // namespace windfall::render
