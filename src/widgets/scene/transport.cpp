#include "widgets/scene/transport.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QToolButton>
#include <QVBoxLayout>

#include "widgets/look/icon.h"
#include "widgets/look/look.h"
#include "widgets/scene/simulation_controller.h"

namespace windfall::widgets {

Transport::Transport(SimulationController& controller, QWidget* parent)
    : QWidget(parent),
      controller_(controller),
      play_(new QAction(icon("play"), tr("Play"), this)),
      step_(new QAction(icon("step"), tr("Step"), this)),
      reset_(new QAction(icon("reset"), tr("Back to the start"), this)),
      time_(new QLabel(this)),
      lost_(new QLabel(this)) {
  play_->setShortcut(Qt::Key_Space);
  step_->setShortcut(Qt::Key_Right);
  reset_->setShortcut(QKeySequence("Ctrl+Home"));
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(kGrid);
  for (QAction* action : {play_, step_, reset_}) {
    auto* button = new QToolButton(this);
    button->setDefaultAction(action);
    button->setIconSize({20, 20});
    button->setFocusPolicy(Qt::NoFocus);
    button->setToolTip(
        QStringLiteral("%1 (%2)").arg(action->text(), action->shortcut().toString(QKeySequence::NativeText)));
    buttons->addWidget(button);
  }
  buttons->addStretch(1);
  QFont large = time_->font();
  large.setPointSizeF(large.pointSizeF() * 1.35);
  time_->setFont(large);
  time_->setMinimumWidth(QFontMetrics(large).horizontalAdvance(QStringLiteral("0000.00 s")));
  lost_->setProperty("hint", true);
  auto* numbers = new QHBoxLayout;
  numbers->setSpacing(2 * kGrid);
  numbers->addWidget(time_);
  numbers->addWidget(lost_, 1);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kGrid);
  column->addLayout(buttons);
  column->addLayout(numbers);
  column->addStretch(1);
  setMinimumWidth(208);

  connect(play_, &QAction::triggered, this,
          [this] { controller_.isPlaying() ? controller_.pause() : controller_.play(); });
  connect(step_, &QAction::triggered, this, [this] { controller_.step(); });
  connect(reset_, &QAction::triggered, this, [this] { controller_.reset(); });
  connect(&controller_, &SimulationController::playingChanged, this, &Transport::showState);
  connect(&controller_, &SimulationController::reported, this, &Transport::showState);
  showState();
}

void Transport::showState() {
  const bool playing = controller_.isPlaying();
  if (play_->text() != (playing ? tr("Pause") : tr("Play"))) {
    play_->setText(playing ? tr("Pause") : tr("Play"));
    play_->setIcon(icon(playing ? "pause" : "play"));
  }
  for (QAction* action : {play_, step_, reset_}) action->setEnabled(controller_.hasScene());
  const QLocale locale;
  time_->setText(tr("%1 s").arg(locale.toString(controller_.last().statistics.time, 'f', 2)));
  const double lost = controller_.lostTime();
  lost_->setText(lost > 0.005 ? tr("%1 s lost").arg(locale.toString(lost, 'f', 2)) : QString());
  lost_->setToolTip(lost > 0.005 ? tr("Real time that this machine was too slow to simulate since play began")
                                 : QString());
}

}  // namespace windfall::widgets
