// The tools of the leaf workspace, one function each; tools.cpp puts them in order.
#pragma once

#include <memory>

#include "widgets/tools/tool.h"

namespace windfall::widgets {

std::unique_ptr<Tool> makeBrush(bool erases);
std::unique_ptr<Tool> makeLineTool();
std::unique_ptr<Tool> makeFillTool();
std::unique_ptr<Tool> makeLasso();
std::unique_ptr<Tool> makeScribbleTool();
std::unique_ptr<Tool> makeRulerTool();
std::unique_ptr<Tool> makeRootTool();
std::unique_ptr<Tool> makeTipTool();
std::unique_ptr<Tool> makeVeinPen();
std::unique_ptr<Tool> makeVeinEditTool();
std::unique_ptr<Tool> makeLinkTool();
std::unique_ptr<Tool> makeMarkerTool();

}  // namespace windfall::widgets
