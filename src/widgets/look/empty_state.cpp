#include "widgets/look/empty_state.h"

#include <QEvent>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>

#include "widgets/look/icon.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

namespace {
constexpr int kButtonWidth = 240;
}

EmptyState::EmptyState(const QString& iconName, const QString& title, const QString& text, QWidget* parent)
    : QWidget(parent),
      iconName_(iconName),
      icon_(new QLabel(this)),
      links_(new QLabel(this)),
      buttons_(new QVBoxLayout) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(6 * kGrid, 6 * kGrid, 6 * kGrid, 6 * kGrid);
  column->setSpacing(2 * kGrid);
  auto* heading = new QLabel(title, this);
  QFont font = heading->font();
  font.setPointSizeF(font.pointSizeF() * 1.5);
  font.setWeight(QFont::DemiBold);
  heading->setFont(font);
  auto* body = new QLabel(text, this);
  body->setProperty("hint", true);
  body->setWordWrap(true);
  body->setAlignment(Qt::AlignCenter);
  body->setFixedWidth(420);
  links_->setTextFormat(Qt::RichText);
  links_->setAlignment(Qt::AlignCenter);
  links_->hide();
  buttons_->setSpacing(2 * kGrid);
  column->addStretch(2);
  column->addWidget(icon_, 0, Qt::AlignHCenter);
  column->addWidget(heading, 0, Qt::AlignHCenter);
  column->addWidget(body, 0, Qt::AlignHCenter);
  column->addSpacing(3 * kGrid);
  column->addLayout(buttons_);
  column->addSpacing(4 * kGrid);
  column->addWidget(links_, 0, Qt::AlignHCenter);
  column->addStretch(3);
  connect(links_, &QLabel::linkActivated, this, &EmptyState::linkActivated);
  updateIcon();
}

QPushButton* EmptyState::addButton(const QString& text, const QString& iconName, bool primary) {
  auto* button = new QPushButton(text, this);
  button->setProperty("primary", primary);
  // On the accent the icon would have the wrong colour.
  if (!iconName.isEmpty() && !primary) button->setIcon(icon(iconName));
  button->setIconSize({16, 16});
  button->setMinimumHeight(32);
  button->setFixedWidth(kButtonWidth);
  buttons_->addWidget(button, 0, Qt::AlignHCenter);
  return button;
}

void EmptyState::setLinks(const QString& title, const QStringList& texts, const QStringList& targets) {
  QString html =
      QStringLiteral("<p style='color:%1'>%2</p>").arg(colors(palette()).muted.name(), title.toHtmlEscaped());
  for (int i = 0; i < texts.size(); ++i) {
    html += QStringLiteral("<p style='line-height:140%'><a style='text-decoration:none' href=\"%1\">%2</a></p>")
                .arg(targets[i].toHtmlEscaped(), texts[i].toHtmlEscaped());
  }
  links_->setText(html);
  links_->setVisible(!texts.isEmpty());
}

void EmptyState::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), colors(palette()).canvas);
}

void EmptyState::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) updateIcon();
}

void EmptyState::updateIcon() {
  icon_->setPixmap(iconPixmap(iconName_, 64, colors(palette()).muted, devicePixelRatioF()));
}

}  // namespace windfall::widgets
