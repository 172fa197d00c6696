// Ctrl+C cancels work cleanly: nothing half-written stays, the exit status is 130.
#pragma once

#include "model/progress.h"

namespace windfall::app {

/// A Progress that SIGINT and SIGTERM cancel while it lives. One at a time.
class InterruptProgress : public model::Progress {
 public:
  InterruptProgress();
  ~InterruptProgress() override;
  InterruptProgress(const InterruptProgress&) = delete;
  InterruptProgress& operator=(const InterruptProgress&) = delete;

  bool cancelled() const override;
};

}  // namespace windfall::app
