// Fill: connected places of one colour change their side of the mask.
#include <QCoreApplication>
#include <cmath>

#include "model/leaf/mask_edit.h"
#include "widgets/tools/leaf_tools.h"

namespace windfall::widgets {

namespace {

constexpr double kTolerance = 14;  // Delta E

class FillTool : public Tool {
 public:
  QString id() const override { return QStringLiteral("fill"); }
  QString title() const override { return QCoreApplication::translate("Tools", "Fill mask"); }
  QString help() const override {
    return QCoreApplication::translate("Tools",
                                       "Click a place of one colour: it becomes leaf, with all alike around it. "
                                       "Ctrl: it becomes ground. Shift: also what is less alike.");
  }
  QKeySequence shortcut() const override { return Qt::Key_F; }
  std::optional<model::Stage> stage() const override { return model::Stage::Mask; }

  void press(const ToolEvent& event, ToolHost&) override { pressed_ = event.buttons & Qt::LeftButton; }
  void release(const ToolEvent& event, ToolHost& host) override {
    if (!std::exchange(pressed_, false)) return;
    const model::LeafStages* stages = host.stages();
    const QImage mask = host.currentMask();
    const QPoint at(int(std::floor(event.position.x())), int(std::floor(event.position.y())));
    if (!stages || mask.isNull() || !mask.valid(at)) return;
    const bool erase = event.modifiers & Qt::ControlModifier;
    const double tolerance = event.modifiers & Qt::ShiftModifier ? 2 * kTolerance : kTolerance;
    host.computeMask(erase ? QCoreApplication::translate("Tools", "Fill with ground")
                           : QCoreApplication::translate("Tools", "Fill with leaf"),
                     [mask, photo = stages->photo, at, erase, tolerance](model::Progress&) -> Result<QImage> {
                       return model::floodedMask(mask, photo, at, tolerance, erase ? 0 : 255);
                     });
  }
  void cancel(ToolHost&) override { pressed_ = false; }

 private:
  bool pressed_ = false;
};

}  // namespace

std::unique_ptr<Tool> makeFillTool() { return std::make_unique<FillTool>(); }

}  // namespace windfall::widgets
