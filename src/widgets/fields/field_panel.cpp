#include "widgets/fields/field_panel.h"

#include <QPushButton>
#include <QSettings>
#include <QToolButton>
#include <QVBoxLayout>

#include "widgets/fields/field.h"
#include "widgets/look/icon.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

FieldGroup::FieldGroup(const QString& title, QWidget* parent)
    : QWidget(parent), header_(new QToolButton(this)), body_(new QWidget(this)), rows_(new QVBoxLayout(body_)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  header_->setText(title);
  header_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  header_->setIconSize({12, 12});
  header_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  header_->setFixedHeight(28);
  QFont font = header_->font();
  font.setWeight(QFont::DemiBold);
  header_->setFont(font);
  rows_->setContentsMargins(2 * kGrid, 0, kGrid, 3 * kGrid);
  rows_->setSpacing(kGrid);
  column->addWidget(header_);
  column->addWidget(body_);
  setFolded(false);
  connect(header_, &QToolButton::clicked, this, [this] {
    setFolded(!folded_);
    emit foldedChanged(folded_);
  });
}

void FieldGroup::addWidget(QWidget* widget) { rows_->addWidget(widget); }

QPushButton* FieldGroup::addButton(const QString& text, const QString& iconName) {
  auto* button = new QPushButton(text, body_);
  if (!iconName.isEmpty()) button->setIcon(icon(iconName));
  button->setIconSize({16, 16});
  rows_->addWidget(button);
  return button;
}

void FieldGroup::setFolded(bool folded) {
  folded_ = folded;
  body_->setVisible(!folded);
  header_->setIcon(icon(folded ? QStringLiteral("chevron-right") : QStringLiteral("chevron-down")));
}

FieldPanel::FieldPanel(const QString& id, QWidget* parent) : QScrollArea(parent), id_(id) {
  auto* inside = new QWidget(this);
  column_ = new QVBoxLayout(inside);
  column_->setContentsMargins(kGrid, 0, kGrid, 2 * kGrid);
  column_->setSpacing(0);
  column_->addStretch(1);
  setWidget(inside);
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setMinimumWidth(296);
}

FieldGroup* FieldPanel::addGroup(const QString& groupId, const QString& title) {
  auto* group = new FieldGroup(title, widget());
  const QString key = QStringLiteral("folded/%1/%2").arg(id_, groupId);
  group->setFolded(QSettings().value(key, false).toBool());
  connect(group, &FieldGroup::foldedChanged, this, [key](bool folded) { QSettings().setValue(key, folded); });
  addWidget(group);
  return group;
}

void FieldPanel::addWidget(QWidget* widget) { column_->insertWidget(column_->count() - 1, widget); }

}  // namespace windfall::widgets
