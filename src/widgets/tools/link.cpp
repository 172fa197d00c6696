// Link: which region of the example lends its colours to which region here.
#include <QCoreApplication>
#include <QPainter>

#include "model/leaf/region_match.h"
#include "widgets/tools/leaf_tools.h"

namespace windfall::widgets {

namespace {

class LinkTool : public Tool {
 public:
  QString id() const override { return QStringLiteral("link"); }
  QString title() const override { return QCoreApplication::translate("Tools", "Match regions"); }
  QString help() const override {
    return QCoreApplication::translate("Tools",
                                       "Equal colours go together. Click a region here, then the one in the example "
                                       "that shall lend it its colours. Ctrl+click: automatic again.");
  }
  QKeySequence shortcut() const override { return Qt::Key_C; }
  std::optional<model::Stage> stage() const override { return model::Stage::Regions; }

  void press(const ToolEvent& event, ToolHost&) override { pressed_ = event.buttons & Qt::LeftButton; }
  void release(const ToolEvent& event, ToolHost& host) override {
    if (!std::exchange(pressed_, false)) return;
    const model::LeafStages* stages = host.stages();
    if (!stages || stages->reached < model::Stage::Regions) return;
    const int region = model::regionAt(*stages, stages->grown.regions, event.position);
    if (region == 0) {
      chosen_.reset();
    } else if (event.modifiers & Qt::ControlModifier) {
      chosen_.reset();
      std::vector<model::RegionPair> pairs = host.document().project().leaf(host.leaf())->regionPairs;
      std::erase_if(pairs, [&](const model::RegionPair& pair) {
        return model::regionAt(*stages, stages->grown.regions, pair.target) == region;
      });
      host.document().setLeaf(host.leaf(), &model::Leaf::regionPairs, pairs, model::Aspect::LeafExamples,
                              QCoreApplication::translate("Tools", "Automatic match of a region"));
    } else {
      chosen_ = event.position;
    }
    host.chooseRegion(chosen_);
    host.requestUpdate();
  }
  void cancel(ToolHost& host) override {
    pressed_ = false;
    chosen_.reset();
    host.chooseRegion({});
    host.requestUpdate();
  }
  void paint(QPainter& painter, const ToolHost& host) const override {
    const double pixel = host.pixelSize();
    const model::Leaf* leaf = const_cast<ToolHost&>(host).document().project().leaf(host.leaf());
    if (!leaf) return;
    const auto dot = [&](QPointF place, const QColor& colour, double radius) {
      painter.setPen(QPen(QColor(0, 0, 0, 200), 1.5 * pixel));
      painter.setBrush(colour);
      painter.drawEllipse(place, radius * pixel, radius * pixel);
    };
    for (const model::RegionPair& pair : leaf->regionPairs) dot(pair.target, QColor(255, 214, 92), 4);
    if (chosen_) dot(*chosen_, Qt::white, 6);
  }

 private:
  std::optional<QPointF> chosen_;
  bool pressed_ = false;
};

}  // namespace

std::unique_ptr<Tool> makeLinkTool() { return std::make_unique<LinkTool>(); }

}  // namespace windfall::widgets
