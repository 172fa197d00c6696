// What runs in the background: title, share done, cancel.
#pragma once

#include <QWidget>

#include "model/document/job.h"

class QLabel;
class QProgressBar;
class QTimer;
class QToolButton;

namespace windfall::widgets {

/// Shows the newest job and how many others there are. Jobs that end within a fifth of a second never show, so that
/// nothing flickers while values are dragged.
class JobsIndicator : public QWidget {
  Q_OBJECT
 public:
  explicit JobsIndicator(model::JobRunner& jobs, QWidget* parent = nullptr);

 private:
  void refresh();

  model::JobRunner& jobs_;
  QLabel* title_;
  QProgressBar* bar_;
  QToolButton* cancel_;
  QTimer* delay_;
};

}  // namespace windfall::widgets
