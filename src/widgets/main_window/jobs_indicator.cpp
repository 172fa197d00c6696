#include "widgets/main_window/jobs_indicator.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QTimer>
#include <QToolButton>

#include "widgets/look/icon.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

JobsIndicator::JobsIndicator(model::JobRunner& jobs, QWidget* parent)
    : QWidget(parent),
      jobs_(jobs),
      title_(new QLabel(this)),
      bar_(new QProgressBar(this)),
      cancel_(new QToolButton(this)),
      delay_(new QTimer(this)) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(2 * kGrid);
  title_->setProperty("hint", true);
  bar_->setTextVisible(false);
  bar_->setRange(0, 1000);
  bar_->setFixedWidth(96);
  cancel_->setIcon(icon(QStringLiteral("close")));
  cancel_->setIconSize({12, 12});
  cancel_->setFixedSize(20, 20);
  cancel_->setToolTip(tr("Cancel"));
  row->addWidget(title_);
  row->addWidget(bar_);
  row->addWidget(cancel_);
  delay_->setSingleShot(true);
  delay_->setInterval(200);
  for (QWidget* part : {static_cast<QWidget*>(title_), static_cast<QWidget*>(bar_), static_cast<QWidget*>(cancel_)}) {
    part->hide();
  }
  connect(delay_, &QTimer::timeout, this, &JobsIndicator::refresh);
  connect(cancel_, &QToolButton::clicked, this, [this] { jobs_.cancelAll(); });
  connect(&jobs_, &model::JobRunner::started, this, [this](model::Job* job) {
    if (!title_->isVisible() && !delay_->isActive()) delay_->start();
    connect(job, &model::Job::progressed, this, [this] {
      if (title_->isVisible()) refresh();
    });
    // After the runner has forgotten it.
    connect(job, &model::Job::finished, this, &JobsIndicator::refresh, Qt::QueuedConnection);
  });
}

void JobsIndicator::refresh() {
  const std::vector<model::Job*> running = jobs_.running();
  const bool busy = !running.empty();
  if (busy && delay_->isActive()) return;
  title_->setVisible(busy);
  bar_->setVisible(busy);
  cancel_->setVisible(busy);
  if (!busy) return delay_->stop();
  const model::Job* job = running.back();
  const int others = int(running.size()) - 1;
  title_->setText(others > 0 ? tr("%1 and %n more", nullptr, others).arg(job->title()) : job->title());
  const double fraction = job->fraction();
  bar_->setRange(0, fraction > 0 ? 1000 : 0);
  bar_->setValue(int(fraction * 1000));
}

}  // namespace windfall::widgets
