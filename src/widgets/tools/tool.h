// Tools of the image pane: small state machines over plain events, tested without a window.
#pragma once

#include <QImage>
#include <QKeySequence>
#include <QPointF>
#include <QRect>
#include <QString>
#include <QStringList>
#include <Qt>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "model/document/document.h"
#include "model/leaf/stages.h"

class QPainter;

namespace windfall::widgets {

/// A pointer event in photo pixels.
struct ToolEvent {
  QPointF position;
  Qt::MouseButtons buttons;
  Qt::KeyboardModifiers modifiers;
  double pressure = 1;  ///< 0..1
  qint64 time = 0;      ///< ms
};

/// What a tool may ask of whoever hosts it.
class ToolHost {
 public:
  virtual ~ToolHost() = default;
  virtual model::Document& document() = 0;
  /// The leaf shown; 0: none, and then tools get no events.
  virtual model::AssetId leaf() const = 0;
  /// Mask as shown now: the artist's, or the automatic one.
  virtual QImage currentMask() const = 0;
  /// Root and region markers as used now: the artist's, or the automatic ones. Null and empty until they are computed.
  virtual std::optional<QPointF> currentRoot() const = 0;
  virtual std::vector<QPointF> currentMarkers() const = 0;
  /// Main tips and veins as used now; empty until they are computed.
  virtual std::vector<QPointF> currentTips() const { return {}; }
  virtual model::Veins currentVeins() const { return {}; }
  /// What is known of the leaf, perhaps out of date; null before the first result.
  virtual const model::LeafStages* stages() const { return nullptr; }
  /// Computes another mask in the background (`work` owns all it touches) and paints it as one undo step.
  virtual void computeMask(const QString& text, const std::function<Result<QImage>(model::Progress&)>& work) {
    model::Progress progress;
    if (Result<QImage> mask = work(progress)) document().paintMask(leaf(), *mask, {}, text);
  }
  /// The region of this leaf that the next click in the example pairs with; absent: none.
  virtual void chooseRegion(std::optional<QPointF>) {}
  /// Draws an unfinished stroke without touching the document; a null image ends it.
  virtual void previewMask(const QImage& mask, QRect dirty) = 0;
  /// Photo pixels that a screen pixel covers, for handles and hit tests.
  virtual double pixelSize() const = 0;
  virtual void requestUpdate() = 0;
};

/// A number or choice of a tool, for the row above the canvas.
struct ToolOption {
  QString id, label, unit, help;  ///< all but the id translated
  double value = 0;               ///< of a choice: its index
  double minimum = 0, maximum = 1, standard = 0;
  int decimals = 0;
  QStringList choices = {};  ///< empty: a number, its slider logarithmic
};

class Tool {
 public:
  virtual ~Tool() = default;
  virtual QString id() const = 0;     ///< "brush"; names the icon too
  virtual QString title() const = 0;  ///< translated
  virtual QString help() const = 0;   ///< one translated line for the status bar
  virtual QKeySequence shortcut() const = 0;
  virtual Qt::CursorShape cursor() const { return Qt::CrossCursor; }
  /// The stage whose picture the tool works on; it is shown when the tool is chosen.
  virtual std::optional<model::Stage> stage() const { return {}; }
  /// A drag moves the picture instead of reaching the tool.
  virtual bool pans() const { return false; }
  /// Diameter in photo pixels; 0: the tool has no size.
  virtual double size() const { return 0; }
  virtual void setSize(double) {}

  /// What can be set now; by itself the size, where the tool has one.
  virtual std::vector<ToolOption> options(ToolHost& host) const;
  /// Options with an equal `gesture` are one undo step, where they are edits at all.
  virtual void setOption(const QString& id, double value, const QString& gesture, ToolHost& host);

  virtual void press(const ToolEvent&, ToolHost&) {}
  virtual void move(const ToolEvent&, ToolHost&) {}
  virtual void release(const ToolEvent&, ToolHost&) {}
  /// Esc, a change of tool, another leaf, closing: back to where the stroke began.
  virtual void cancel(ToolHost&) {}
  /// Whether the tool uses Delete, + and − and Alt+1 to 4; true from `key`: it did.
  virtual bool takesKeys() const { return false; }
  virtual bool key(int, Qt::KeyboardModifiers, ToolHost&) { return false; }
  /// Brush circle, handles; photo coordinates.
  virtual void paint(QPainter&, const ToolHost&) const {}
};

/// Every tool of the leaf workspace, in the order of the work. A new tool is one file and one line in tools.cpp.
std::vector<std::unique_ptr<Tool>> makeLeafTools();

}  // namespace windfall::widgets
