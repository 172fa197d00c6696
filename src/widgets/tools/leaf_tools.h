// The tools of the leaf workspace, one function each; tools.cpp puts them in order.
#pragma once

#include <memory>

#include "widgets/tools/tool.h"

namespace windfall::widgets {

std::unique_ptr<Tool> makeBrush(bool erases);
std::unique_ptr<Tool> makeLasso();
std::unique_ptr<Tool> makeRootTool();
std::unique_ptr<Tool> makeMarkerTool();

}  // namespace windfall::widgets
