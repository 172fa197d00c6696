#include "widgets/tools/vein_look.h"

#include <QCoreApplication>
#include <algorithm>

namespace windfall::widgets {

model::Veins handVeins(ToolHost& host) {
  const model::Leaf* leaf = host.document().project().leaf(host.leaf());
  if (leaf && !leaf->veins.empty()) return leaf->veins;
  const model::LeafStages* stages = host.stages();
  const double side = stages ? std::max(stages->frame.width(), stages->frame.height()) : 512;
  return model::editableVeins(host.currentVeins(), std::max(0.3, side / 900));
}

ToolOption orderOption(int order, bool automatic) {
  QStringList choices{QCoreApplication::translate("Tools", "Main"), QCoreApplication::translate("Tools", "Lateral"),
                      QCoreApplication::translate("Tools", "Tertiary"), QCoreApplication::translate("Tools", "Micro")};
  if (automatic) choices.prepend(QCoreApplication::translate("Tools", "By its place"));
  const int last = static_cast<int>(choices.size()) - 1;
  const auto chosen = static_cast<double>(std::clamp(automatic ? order : order - 1, 0, last));
  return {QStringLiteral("order"),
          QCoreApplication::translate("Tools", "Order"),
          {},
          automatic
              ? QCoreApplication::translate("Tools", "By its place: one order below the vein that it leaves")
              : QCoreApplication::translate("Tools", "What leaves the vein keeps its distance in order (Alt+1 to 4)"),
          chosen,
          0,
          static_cast<double>(last),
          automatic ? 0 : chosen,
          0,
          choices};
}

}  // namespace windfall::widgets
