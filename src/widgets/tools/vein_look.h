// What the two tools for veins share.
#pragma once

#include "model/leaf/vein_graph.h"
#include "widgets/tools/tool.h"

namespace windfall::widgets {

/// The veins as the artist's own: those of the document, or the ones that are shown now with few enough points to be
/// moved. Finer veins that were grown stay as they are.
model::Veins handVeins(ToolHost& host);

/// The choice of an order; `automatic`: "By its place" comes first, else main veins do. Values are orders, less one
/// where nothing is automatic.
ToolOption orderOption(int order, bool automatic);

}  // namespace windfall::widgets
