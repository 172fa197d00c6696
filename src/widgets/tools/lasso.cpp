// Lasso: what is inside the drawn outline becomes leaf, or with Ctrl background.
#include <QCoreApplication>
#include <QPainter>

#include "widgets/tools/leaf_tools.h"
#include "widgets/tools/mask_stroke.h"

namespace windfall::widgets {

namespace {

class Lasso : public Tool {
 public:
  QString id() const override { return QStringLiteral("lasso"); }
  QString title() const override { return QCoreApplication::translate("Tools", "Lasso"); }
  QString help() const override {
    return QCoreApplication::translate("Tools", "Draw around a part of the leaf. Ctrl: take it out of the mask.");
  }
  QKeySequence shortcut() const override { return Qt::Key_L; }
  std::optional<model::Stage> stage() const override { return model::Stage::Mask; }

  void press(const ToolEvent& event, ToolHost&) override {
    if (event.buttons & Qt::LeftButton) outline_ = QPolygonF({event.position});
  }
  void move(const ToolEvent& event, ToolHost& host) override {
    if (outline_.isEmpty()) return;
    outline_ << event.position;
    host.requestUpdate();
  }
  void release(const ToolEvent& event, ToolHost& host) override {
    const QPolygonF outline = std::exchange(outline_, {});
    host.requestUpdate();
    // Fewer points enclose nothing: a click.
    if (outline.size() < 3) return;
    MaskStroke stroke;
    if (!stroke.begin(host)) return;
    QPainterPath area;
    area.addPolygon(outline);
    area.closeSubpath();
    const bool erase = event.modifiers & Qt::ControlModifier;
    stroke.fill(area, erase ? 0 : 255, host);
    stroke.finish(erase ? QCoreApplication::translate("Tools", "Cut from mask")
                        : QCoreApplication::translate("Tools", "Add to mask"),
                  host);
  }
  void cancel(ToolHost& host) override {
    outline_.clear();
    host.requestUpdate();
  }
  void paint(QPainter& painter, const ToolHost& host) const override {
    if (outline_.size() < 2) return;
    const double pixel = host.pixelSize();
    painter.setBrush(QColor(255, 255, 255, 40));
    painter.setPen(QPen(QColor(0, 0, 0, 160), 3 * pixel));
    painter.drawPolygon(outline_);
    painter.setPen(QPen(Qt::white, 1.25 * pixel, Qt::DashLine));
    painter.drawPolygon(outline_);
  }

 private:
  QPolygonF outline_;
};

}  // namespace

std::unique_ptr<Tool> makeLasso() { return std::make_unique<Lasso>(); }

}  // namespace windfall::widgets
