// Vein edit: points of veins added, moved, deleted; widths and orders.
#include <QCoreApplication>
#include <QPainter>
#include <QPolygonF>
#include <cmath>

#include "model/leaf/vein_curve.h"
#include "widgets/tools/leaf_tools.h"
#include "widgets/tools/vein_look.h"

namespace windfall::widgets {

namespace {

constexpr double kReach = 9;      // screen px
constexpr int kHighestShown = 3;  // finer veins are too many to be taken by hand
constexpr double kWider = 1.15;

class VeinEditTool : public Tool {
 public:
  QString id() const override { return QStringLiteral("vein-edit"); }
  QString title() const override { return QCoreApplication::translate("Tools", "Edit veins"); }
  QString help() const override {
    return QCoreApplication::translate("Tools",
                                       "Click a vein to choose it; drag its points, double-click its line to add one. "
                                       "Delete: the point, Shift+Delete: the vein. + and −: width, Alt+1 to 4: order.");
  }
  QKeySequence shortcut() const override { return Qt::Key_A; }
  Qt::CursorShape cursor() const override { return Qt::ArrowCursor; }
  std::optional<model::Stage> stage() const override { return model::Stage::Veins; }

  std::vector<ToolOption> options(ToolHost& host) const override {
    const model::Veins veins = handVeins(host);
    if (vein_ < 0 || vein_ >= int(veins.size())) return {};
    const model::Vein& vein = veins[std::size_t(vein_)];
    const auto width = [](const char* id, const QString& label, double value) {
      return ToolOption{QString::fromLatin1(id),
                        label,
                        QStringLiteral("px"),
                        QCoreApplication::translate("Tools",
                                                    "Width of the chosen vein in pixels of the photo (+ and −: "
                                                    "both)"),
                        value,
                        0.25,
                        60,
                        value,
                        1};
    };
    return {width("startWidth", QCoreApplication::translate("Tools", "Width"), vein.startWidth),
            width("endWidth", QCoreApplication::translate("Tools", "At its end"), vein.endWidth),
            orderOption(vein.order, false)};
  }
  void setOption(const QString& id, double value, const QString& gesture, ToolHost& host) override {
    veins_ = handVeins(host);
    if (vein_ < 0 || vein_ >= int(veins_.size())) return;
    model::Veins veins = veins_;
    if (id == QLatin1String("order")) {
      veins = model::withOrder(veins, vein_, static_cast<int>(value) + 1);
    } else {
      model::Vein& vein = veins[std::size_t(vein_)];
      (id == QLatin1String("startWidth") ? vein.startWidth : vein.endWidth) = value;
    }
    host.document().setLeaf(host.leaf(), &model::Leaf::veins, veins, model::Aspect::LeafVeins,
                            id == QLatin1String("order") ? QCoreApplication::translate("Tools", "Order of a vein")
                                                         : QCoreApplication::translate("Tools", "Width of a vein"),
                            gesture);
    host.requestUpdate();
  }

  void press(const ToolEvent& event, ToolHost& host) override {
    if (!(event.buttons & Qt::LeftButton)) return;
    const bool again = event.time - pressedAt_ < 400 && near(event.position, lastPress_, 4 * host.pixelSize());
    pressedAt_ = event.time;
    lastPress_ = event.position;
    veins_ = handVeins(host);
    const double reach = kReach * host.pixelSize();
    // The points of the chosen vein lie on top.
    if (const int point = pointAt(event.position, reach); point >= 0) {
      point_ = point;
      dragged_ = true;
      moved_ = false;
      host.requestUpdate();
      return;
    }
    const std::optional<model::VeinPlace> place = model::nearestVein(veins_, event.position, reach, kHighestShown);
    if (!place) {
      vein_ = point_ = -1;
    } else if (again && place->vein == vein_) {
      commit(model::withPoint(veins_, vein_, place->segment, place->at),
             QCoreApplication::translate("Tools", "Add a point of a vein"), host);
      point_ = place->segment + 1;
    } else {
      vein_ = place->vein;
      point_ =
          near(veins_[std::size_t(vein_)].points[std::size_t(place->point)], event.position, reach) ? place->point : -1;
      dragged_ = point_ >= 0;
      moved_ = false;
    }
    host.requestUpdate();
  }
  void move(const ToolEvent& event, ToolHost& host) override {
    if (!dragged_) return;
    if (!moved_ && near(event.position, lastPress_, 2 * host.pixelSize())) return;
    moved_ = true;
    place_ = event.position;
    host.requestUpdate();
  }
  void release(const ToolEvent&, ToolHost& host) override {
    if (!std::exchange(dragged_, false)) return;
    if (std::exchange(moved_, false)) {
      commit(model::withMovedPoint(veins_, vein_, point_, place_),
             QCoreApplication::translate("Tools", "Move a point of a vein"), host);
    }
    host.requestUpdate();
  }
  void cancel(ToolHost& host) override {
    dragged_ = moved_ = false;
    vein_ = point_ = -1;
    host.requestUpdate();
  }

  bool takesKeys() const override { return vein_ >= 0; }
  bool key(int key, Qt::KeyboardModifiers modifiers, ToolHost& host) override {
    veins_ = handVeins(host);
    if (dragged_ || vein_ < 0 || vein_ >= int(veins_.size())) return false;
    if (key == Qt::Key_Delete || key == Qt::Key_Backspace) {
      const bool whole = point_ < 0 || modifiers & Qt::ShiftModifier;
      const int before = int(veins_.size());
      commit(whole ? model::withoutVein(veins_, vein_) : model::withoutPoint(veins_, vein_, point_),
             whole ? QCoreApplication::translate("Tools", "Delete a vein")
                   : QCoreApplication::translate("Tools", "Delete a point of a vein"),
             host);
      if (int(handVeins(host).size()) != before) vein_ = -1;
      point_ = -1;
    } else if (key == Qt::Key_Plus || key == Qt::Key_Equal || key == Qt::Key_Minus) {
      commit(model::withWidth(veins_, vein_, key == Qt::Key_Minus ? 1 / kWider : kWider),
             QCoreApplication::translate("Tools", "Width of a vein"), host);
    } else if (key >= Qt::Key_1 && key <= Qt::Key_4 && modifiers & Qt::AltModifier) {
      commit(model::withOrder(veins_, vein_, key - Qt::Key_0), QCoreApplication::translate("Tools", "Order of a vein"),
             host);
    } else {
      return false;
    }
    host.requestUpdate();
    return true;
  }

  void paint(QPainter& painter, const ToolHost& host) const override {
    const double pixel = host.pixelSize();
    model::Veins veins = handVeins(const_cast<ToolHost&>(host));
    if (moved_) veins = model::withMovedPoint(veins, vein_, point_, place_);
    painter.setBrush(Qt::NoBrush);
    for (std::size_t i = 0; i < veins.size(); ++i) {
      if (veins[i].order > kHighestShown) continue;
      const bool chosen = int(i) == vein_;
      const model::Polygon curve = model::throughPoints(veins[i].points);
      const QPolygonF line(QList<QPointF>(curve.begin(), curve.end()));
      painter.setPen(QPen(QColor(0, 0, 0, 150), (chosen ? 4.5 : 3) * pixel));
      painter.drawPolyline(line);
      painter.setPen(QPen(chosen ? QColor(120, 220, 255) : QColor(255, 226, 120, 200), (chosen ? 2.5 : 1.25) * pixel));
      painter.drawPolyline(line);
    }
    if (vein_ < 0 || vein_ >= int(veins.size())) return;
    const std::vector<QPointF>& points = veins[std::size_t(vein_)].points;
    for (std::size_t k = 0; k < points.size(); ++k) {
      painter.setPen(QPen(QColor(0, 0, 0, 200), 1.5 * pixel));
      painter.setBrush(int(k) == point_ ? QColor(120, 220, 255) : QColor(Qt::white));
      const double r = 3.5 * pixel;
      painter.drawRect(QRectF(points[k] - QPointF(r, r), QSizeF(2 * r, 2 * r)));
    }
  }

 private:
  static bool near(QPointF a, QPointF b, double reach) { return std::hypot(a.x() - b.x(), a.y() - b.y()) <= reach; }
  int pointAt(QPointF at, double reach) const {
    if (vein_ < 0 || vein_ >= int(veins_.size())) return -1;
    int best = -1;
    const std::vector<QPointF>& points = veins_[std::size_t(vein_)].points;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double distance = std::hypot(points[k].x() - at.x(), points[k].y() - at.y());
      if (distance > reach) continue;
      reach = distance;
      best = int(k);
    }
    return best;
  }
  static void commit(const model::Veins& veins, const QString& text, ToolHost& host) {
    host.document().setLeaf(host.leaf(), &model::Leaf::veins, veins, model::Aspect::LeafVeins, text);
  }

  model::Veins veins_;
  int vein_ = -1, point_ = -1;
  bool dragged_ = false, moved_ = false;
  QPointF place_, lastPress_;
  qint64 pressedAt_ = -1000;
};

}  // namespace

std::unique_ptr<Tool> makeVeinEditTool() { return std::make_unique<VeinEditTool>(); }

}  // namespace windfall::widgets
