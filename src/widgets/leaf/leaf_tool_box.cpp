#include "widgets/leaf/leaf_tool_box.h"

#include <cmath>

#include "widgets/look/icon.h"

namespace windfall::widgets {

LeafToolBox::LeafToolBox(model::Document& document, model::JobRunner& jobs, LeafPictures& pictures, ImagePane& pane,
                         QObject* parent)
    : QObject(parent), document_(document), jobs_(jobs), pictures_(pictures), pane_(pane), tools_(makeLeafTools()) {
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    const Tool& tool = *tools_[i];
    auto* action = new QAction(icon(tool.id()), tool.title(), this);
    action->setCheckable(true);
    action->setShortcut(tool.shortcut());
    action->setToolTip(tr("%1 (%2)\n%3").arg(tool.title(), tool.shortcut().toString(), tool.help()));
    connect(action, &QAction::triggered, this, [this, i] { chooseIndex(i); });
    actions_ << action;
  }
  actions_.first()->setChecked(true);
  const auto here = [this] { return pictures_.leaf() && !pane_.base().isNull(); };
  connect(&pane_, &ImagePane::pressed, this, [this, here](const ToolEvent& event) {
    if (!here()) return;
    const std::optional<model::Stage> stage = current().stage();
    if (stage && pictures_.wanted() != *stage) emit stageNeeded(*stage);
    current().press(event, *this);
  });
  connect(&pane_, &ImagePane::moved, this, [this, here](const ToolEvent& event) {
    if (here()) current().move(event, *this);
  });
  connect(&pane_, &ImagePane::released, this, [this, here](const ToolEvent& event) {
    if (here()) current().release(event, *this);
  });
  connect(&pane_, &ImagePane::cancelled, this, &LeafToolBox::cancel);
  pane_.setToolPainter([this](QPainter& painter) {
    if (pictures_.leaf()) current().paint(painter, *this);
  });
  pane_.setToolKeys([this] { return pictures_.leaf() && current().takesKeys(); },
                    [this](int key, Qt::KeyboardModifiers modifiers) {
                      return pictures_.leaf() && current().takesKeys() && current().key(key, modifiers, *this);
                    });
  chooseIndex(0);
}

LeafToolBox::~LeafToolBox() {
  pane_.setToolPainter({});
  pane_.setToolKeys({}, {});
}

Tool* LeafToolBox::tool(const QString& id) const {
  for (const auto& tool : tools_) {
    if (tool->id() == id) return tool.get();
  }
  return nullptr;
}

void LeafToolBox::choose(const QString& id) {
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    if (tools_[i]->id() == id) chooseIndex(i);
  }
}

void LeafToolBox::chooseIndex(std::size_t index) {
  cancel();
  current_ = index;
  for (qsizetype i = 0; i < actions_.size(); ++i) actions_[i]->setChecked(std::size_t(i) == index);
  pane_.setToolCursor(current().cursor(), current().pans());
  pane_.update();
  if (const std::optional<model::Stage> stage = current().stage()) emit stageNeeded(*stage);
  emit toolChanged();
}

void LeafToolBox::cancel() { current().cancel(*this); }

void LeafToolBox::resizeTool(int direction) {
  const double size = current().size();
  if (size > 0) setToolSize(direction > 0 ? std::max(size + 1, size * 1.1) : std::min(size - 1, size / 1.1));
}

void LeafToolBox::setToolSize(double size) {
  // Brush and eraser keep one size, as most painters' programs do.
  for (const auto& tool : tools_) {
    if (tool->size() > 0) tool->setSize(size);
  }
  pane_.update();
  emit toolChanged();
}

void LeafToolBox::setOption(const QString& id, double value, const QString& gesture) {
  if (!pictures_.leaf()) return;
  if (id == QLatin1String("size")) return setToolSize(value);
  current().setOption(id, value, gesture, *this);
  pane_.update();
  emit toolUpdated();
}

std::optional<QPointF> LeafToolBox::currentRoot() const {
  const model::Leaf* shown = pictures_.leaf();
  if (shown && shown->root) return shown->root;
  const model::LeafStages* stages = pictures_.stages();
  if (stages && stages->reached >= model::Stage::Contour) return stages->root;
  return {};
}

std::vector<QPointF> LeafToolBox::currentMarkers() const {
  const model::Leaf* shown = pictures_.leaf();
  if (shown && !shown->markers.empty()) return shown->markers;
  const model::LeafStages* stages = pictures_.stages();
  return stages ? stages->markers : std::vector<QPointF>();
}

std::vector<QPointF> LeafToolBox::currentTips() const {
  const model::Leaf* shown = pictures_.leaf();
  if (shown && !shown->tips.empty()) return shown->tips;
  const model::LeafStages* stages = pictures_.stages();
  if (!stages || stages->reached < model::Stage::Contour) return {};
  return {stages->tip};
}

model::Veins LeafToolBox::currentVeins() const {
  const model::Leaf* shown = pictures_.leaf();
  if (shown && !shown->veins.empty()) return shown->veins;
  const model::LeafStages* stages = pictures_.stages();
  return stages && stages->reached >= model::Stage::Veins ? stages->veins : model::Veins();
}

void LeafToolBox::computeMask(const QString& text, const std::function<Result<QImage>(model::Progress&)>& work) {
  const model::AssetId id = leaf();
  const QImage base = pictures_.mask();
  // A second edit of the same leaf makes the first one's result stale; a scribble knows of those before it.
  jobs_.start<QImage>(text, QStringLiteral("mask-edit:%1").arg(id.value), work,
                      [this, id, text, base](const QImage& mask) {
                        if (leaf() != id) return document_.paintMask(id, mask, {}, text);
                        // A stroke that was painted meanwhile stays.
                        QImage merged = pictures_.mask().copy();
                        if (merged.size() != mask.size() || base.size() != mask.size()) return;
                        for (int y = 0; y < mask.height(); ++y) {
                          const uchar *was = base.constScanLine(y), *is = mask.constScanLine(y);
                          uchar* now = merged.scanLine(y);
                          for (int x = 0; x < mask.width(); ++x) {
                            if (is[x] != was[x]) now[x] = is[x];
                          }
                        }
                        document_.paintMask(id, merged, {}, text);
                      });
}

void LeafToolBox::editMask(const QString& text, std::function<QImage(const QImage&)> edit) {
  const QImage mask = pictures_.mask();
  if (!pictures_.leaf() || mask.isNull()) return;
  computeMask(text, [mask, edit = std::move(edit)](model::Progress&) -> Result<QImage> { return edit(mask); });
}

void LeafToolBox::previewMask(const QImage& mask, QRect dirty) {
  if (pictures_.wanted() != model::Stage::Mask) return;
  const QImage shown = mask.isNull() ? pictures_.mask() : mask;
  const QRect part = dirty & shown.rect();
  if (part.isEmpty()) return;
  if (pane_.overlay().size() != shown.size()) {
    pane_.setOverlay(MipImage(LeafPictures::maskTint(shown, shown.rect())));
  } else {
    pane_.replaceOverlay(LeafPictures::maskTint(shown, part), part.topLeft());
  }
}

}  // namespace windfall::widgets
