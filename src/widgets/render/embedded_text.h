// The shaders of resources/shaders, compiled into the library.
#pragma once

#include <string_view>

namespace windfall::render {

/// The text of a file of resources/shaders by its name; empty where there is none.
std::string_view embeddedText(std::string_view name);

}  // namespace windfall::render
