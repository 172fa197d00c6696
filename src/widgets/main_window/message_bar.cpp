#include "widgets/main_window/message_bar.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QTimer>
#include <QToolButton>

#include "widgets/look/icon.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

namespace {
constexpr int kNoteTime = 8000;  // ms
}

MessageBar::MessageBar(QWidget* parent)
    : QWidget(parent),
      icon_(new QLabel(this)),
      label_(new QLabel(this)),
      close_(new QToolButton(this)),
      button_(new QPushButton(this)),
      fade_(new QTimer(this)) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(2 * kGrid, 0, 0, 0);
  row->setSpacing(2 * kGrid);
  label_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  label_->setTextFormat(Qt::PlainText);
  label_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  close_->setIcon(icon(QStringLiteral("close")));
  close_->setIconSize({12, 12});
  close_->setFixedSize(20, 20);
  close_->setToolTip(tr("Dismiss"));
  row->addWidget(icon_);
  row->addWidget(label_, 1);
  row->addWidget(button_);
  row->addWidget(close_);
  button_->setIconSize({14, 14});
  fade_->setSingleShot(true);
  connect(button_, &QPushButton::clicked, this, [this] {
    const std::function<void()> accept = accept_;
    dismiss();
    if (accept) accept();
  });
  connect(close_, &QToolButton::clicked, this, &MessageBar::dismiss);
  connect(fade_, &QTimer::timeout, this, &MessageBar::dismiss);
  dismiss();
}

void MessageBar::showMessage(const QString& text, bool isError) {
  dismiss();
  text_ = text;
  error_ = isError;
  icon_->show();
  close_->show();
  layOut();
  if (isError) {
    fade_->stop();
  } else {
    fade_->start(kNoteTime);
  }
}

void MessageBar::offer(const QString& text, const QString& button, std::function<void()> accept) {
  showMessage(text, false);
  fade_->stop();
  accept_ = std::move(accept);
  button_->setText(button);
  button_->show();
  layOut();
}

void MessageBar::dismiss() {
  accept_ = {};
  button_->hide();
  text_.clear();
  error_ = false;
  fade_->stop();
  icon_->hide();
  close_->hide();
  layOut();
}

void MessageBar::layOut() {
  const Colors& c = colors(palette());
  if (!text_.isEmpty()) {
    icon_->setPixmap(iconPixmap(error_ ? QStringLiteral("warning") : QStringLiteral("info"), 16,
                                error_ ? c.error : c.accent, devicePixelRatioF()));
  }
  label_->setText(label_->fontMetrics().elidedText(
      text_, Qt::ElideRight, std::max(40, width() - 64 - (button_->isHidden() ? 0 : button_->sizeHint().width() + 8))));
  label_->setToolTip(label_->text() == text_ ? QString() : text_);
}

void MessageBar::resizeEvent(QResizeEvent*) { layOut(); }

void MessageBar::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) layOut();
}

}  // namespace windfall::widgets
