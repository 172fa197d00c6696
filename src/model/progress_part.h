// A part of longer work as a Progress of its own.
#pragma once

#include <mutex>
#include <utility>

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

/// Works that are done at the same time.
class ProgressTogether {
 public:
  explicit ProgressTogether(Progress& whole) : whole_(whole) {}

  /// One of them: its `share` of the whole, and cancelled with it or by itself.
  class Work : public Progress {
   public:
    Work(ProgressTogether& together, double share) : together_(together), share_(share) {}
    void report(double fraction) override { together_.add(share_ * (fraction - std::exchange(done_, fraction))); }
    bool cancelled() const override { return Progress::cancelled() || together_.whole_.cancelled(); }

   private:
    ProgressTogether& together_;
    double share_, done_ = 0;
  };

 private:
  void add(double fraction) {
    const std::lock_guard lock(mutex_);
    whole_.report(done_ += fraction);
  }

  Progress& whole_;
  std::mutex mutex_;
  double done_ = 0;
};

}  // namespace windfall::model
