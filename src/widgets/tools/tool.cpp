#include "widgets/tools/tool.h"

#include <QCoreApplication>

namespace windfall::widgets {

std::vector<ToolOption> Tool::options(ToolHost&) const {
  if (size() <= 0) return {};
  return {{QStringLiteral("size"), QCoreApplication::translate("Tools", "Size"), QStringLiteral("px"),
           QCoreApplication::translate("Tools", "Diameter in pixels of the photo ([ and ], or Shift and drag)"), size(),
           1, 1000, size()}};
}

void Tool::setOption(const QString& id, double value, const QString&, ToolHost&) {
  if (id == QLatin1String("size")) setSize(value);
}

}  // namespace windfall::widgets
