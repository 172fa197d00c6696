#include "widgets/leaf/tool_options.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <algorithm>

#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/leaf/leaf_tool_box.h"
#include "widgets/look/icon.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

namespace {

constexpr int kHeight = 32, kNumber = 232, kChoice = 176;

/// Inspectors line up their labels; here each is as wide as its text.
void tighten(Field* field, int width) {
  for (ElidedLabel* label : field->findChildren<ElidedLabel*>()) {
    label->setFixedWidth(label->sizeHint().width() + kGrid);
    width += label->width() - Field::kLabelWidth / 2;
  }
  field->setFixedWidth(width);
}

}  // namespace

ToolOptions::ToolOptions(QWidget* parent)
    : QWidget(parent),
      icon_(new QLabel(this)),
      title_(new QLabel(this)),
      row_(new QHBoxLayout),
      help_(new ElidedLabel({}, this)) {
  setFixedHeight(kHeight);
  auto* whole = new QHBoxLayout(this);
  whole->setContentsMargins(3 * kGrid, 0, 3 * kGrid, 0);
  whole->setSpacing(2 * kGrid);
  row_->setSpacing(4 * kGrid);
  row_->setContentsMargins(2 * kGrid, 0, 2 * kGrid, 0);
  whole->addWidget(icon_);
  whole->addWidget(title_);
  whole->addLayout(row_);
  whole->addWidget(help_, 1);
}

void ToolOptions::setToolBox(LeafToolBox* toolBox) {
  toolBox_ = toolBox;
  connect(toolBox, &LeafToolBox::toolChanged, this, &ToolOptions::refresh);
  connect(toolBox, &LeafToolBox::toolUpdated, this, &ToolOptions::refresh);
  refresh();
}

Field* ToolOptions::makeField(const ToolOption& option) {
  const QString id = option.id;
  if (!option.choices.isEmpty()) {
    auto* field = new ChoiceField(option.label, option.choices, int(option.standard), this);
    connect(field, &ChoiceField::edited, this,
            [this, id, field](int index) { toolBox_->setOption(id, index, field->gesture()); });
    tighten(field, kChoice);
    return field;
  }
  auto* field = new NumberField(option.label,
                                {.minimum = option.minimum,
                                 .maximum = option.maximum,
                                 .defaultValue = option.standard,
                                 .decimals = option.decimals,
                                 .unit = option.unit,
                                 .logarithmic = option.minimum > 0,
                                 .step = option.decimals > 0 ? 0.5 : 1},
                                this);
  connect(field, &NumberField::edited, this,
          [this, id, field](double value) { toolBox_->setOption(id, value, field->gesture()); });
  tighten(field, kNumber);
  return field;
}

void ToolOptions::refresh() {
  if (!toolBox_) return;
  const Tool& tool = toolBox_->current();
  const std::vector<ToolOption> options = toolBox_->options();
  const bool same = tool.id() == tool_ && std::equal(options.begin(), options.end(), shown_.begin(), shown_.end(),
                                                     [](const ToolOption& a, const ToolOption& b) {
                                                       return a.id == b.id && a.choices == b.choices;
                                                     });
  shown_ = options;
  if (!same) {
    tool_ = tool.id();
    icon_->setPixmap(icon(tool.id()).pixmap(16, 16));
    title_->setText(tool.title());
    help_->setText(tool.help());
    help_->setToolTip(tool.help());
    for (Field* field : fields_) {
      row_->removeWidget(field);
      // Perhaps one of them is being edited right now.
      field->hide();
      field->deleteLater();
    }
    fields_.clear();
    for (const ToolOption& option : options) {
      Field* field = makeField(option);
      field->setToolTip(option.help);
      fields_.insert(option.id, field);
      row_->addWidget(field);
      field->show();
    }
  }
  for (const ToolOption& option : options) {
    if (auto* number = qobject_cast<NumberField*>(fields_.value(option.id))) number->setValue(option.value);
    if (auto* choice = qobject_cast<ChoiceField*>(fields_.value(option.id))) choice->setValue(int(option.value));
  }
}

void ToolOptions::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), colors(palette()).panel);
}

}  // namespace windfall::widgets
