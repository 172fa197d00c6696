// A part of longer work as a Progress of its own.
#pragma once

#include "model/progress.h"

namespace windfall::model {

/// Reports 0..1 as from..to of the whole, and is cancelled with it.
class ProgressPart : public Progress {
 public:
  ProgressPart(Progress& whole, double from, double to) : whole_(whole), from_(from), to_(to) {}

  void report(double fraction) override { whole_.report(from_ + (to_ - from_) * fraction); }
  bool cancelled() const override { return whole_.cancelled(); }
  void cancel() override { whole_.cancel(); }

 private:
  Progress& whole_;
  double from_, to_;
};

}  // namespace windfall::model
