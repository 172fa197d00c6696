#include <QCoreApplication>

#include "widgets/tools/leaf_tools.h"

namespace windfall::widgets {

namespace {

/// Moves the picture, nothing else.
class MoveTool : public Tool {
 public:
  QString id() const override { return QStringLiteral("hand"); }
  QString title() const override { return QCoreApplication::translate("Tools", "Move the picture"); }
  QString help() const override {
    return QCoreApplication::translate(
        "Tools", "Drag moves the picture, the wheel zooms. Space+drag or the middle button do so in every tool.");
  }
  QKeySequence shortcut() const override { return Qt::Key_H; }
  Qt::CursorShape cursor() const override { return Qt::OpenHandCursor; }
  bool pans() const override { return true; }
};

}  // namespace

std::vector<std::unique_ptr<Tool>> makeLeafTools() {
  std::vector<std::unique_ptr<Tool>> tools;
  tools.push_back(std::make_unique<MoveTool>());
  tools.push_back(makeBrush(false));
  tools.push_back(makeBrush(true));
  tools.push_back(makeLineTool());
  tools.push_back(makeFillTool());
  tools.push_back(makeLasso());
  tools.push_back(makeScribbleTool());
  tools.push_back(makeRulerTool());
  tools.push_back(makeRootTool());
  tools.push_back(makeTipTool());
  tools.push_back(makeVeinPen());
  tools.push_back(makeVeinEditTool());
  tools.push_back(makeMarkerTool());
  tools.push_back(makeLinkTool());
  return tools;
}

}  // namespace windfall::widgets
