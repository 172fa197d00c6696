#include "widgets/main_window/dock.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "widgets/look/icon.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

Dock::Dock(const QString& name, const QString& title, QWidget* parent) : QDockWidget(title, parent) {
  setObjectName(name);
  auto* bar = new QWidget(this);
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(3 * kGrid, kGrid, kGrid, kGrid);
  auto* label = new QLabel(title, bar);
  QFont font = label->font();
  font.setWeight(QFont::DemiBold);
  label->setFont(font);
  label->setProperty("hint", true);
  auto* close = new QToolButton(bar);
  close->setIcon(icon(QStringLiteral("close")));
  close->setIconSize({12, 12});
  close->setFixedSize(20, 20);
  close->setToolTip(tr("Hide (Window menu shows it again)"));
  close->setFocusPolicy(Qt::NoFocus);
  row->addWidget(label, 1);
  row->addWidget(close);
  setTitleBarWidget(bar);
  connect(close, &QToolButton::clicked, this, &QDockWidget::close);
  connect(this, &QWidget::windowTitleChanged, label, &QLabel::setText);
}

}  // namespace windfall::widgets
