// The row above the canvas: the tool at work, what can be set of it, and what it does.
#pragma once

#include <QHash>
#include <QWidget>
#include <vector>

#include "widgets/tools/tool.h"

class QHBoxLayout;
class QLabel;

namespace windfall::widgets {

class ElidedLabel;
class Field;
class LeafToolBox;

/// Always there, so that the canvas does not jump when the tool changes.
class ToolOptions : public QWidget {
  Q_OBJECT
 public:
  explicit ToolOptions(QWidget* parent = nullptr);
  void setToolBox(LeafToolBox* toolBox);
  /// The field of an option of the current tool; null: it has none of this name.
  Field* field(const QString& id) const { return fields_.value(id); }

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  void refresh();
  Field* makeField(const ToolOption& option);

  LeafToolBox* toolBox_ = nullptr;
  QLabel *icon_, *title_;
  QHBoxLayout* row_;
  ElidedLabel* help_;
  QHash<QString, Field*> fields_;
  std::vector<ToolOption> shown_;
  QString tool_;
};

}  // namespace windfall::widgets
