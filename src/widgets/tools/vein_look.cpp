#include "widgets/tools/vein_look.h"

#include <algorithm>

namespace windfall::widgets {

model::Veins handVeins(ToolHost& host) {
  const model::Leaf* leaf = host.document().project().leaf(host.leaf());
  if (leaf && !leaf->veins.empty()) return leaf->veins;
  const model::LeafStages* stages = host.stages();
  const double side = stages ? std::max(stages->frame.width(), stages->frame.height()) : 512;
  return model::editableVeins(host.currentVeins(), std::max(0.3, side / 900));
}

}  // namespace windfall::widgets
