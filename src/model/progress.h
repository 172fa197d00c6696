// How long work says how far it is and learns that nobody wants it any more.
#pragma once

#include <atomic>
#include <functional>

namespace windfall::model {

/// Handed to every function that may take longer than a frame. Thread-safe.
class Progress {
 public:
  Progress() = default;
  explicit Progress(std::function<void(double)> report) : report_(std::move(report)) {}
  virtual ~Progress() = default;

  /// 0..1 of the work of whoever holds this.
  virtual void report(double fraction) {
    if (report_) report_(fraction);
  }
  virtual bool cancelled() const { return cancelled_; }
  virtual void cancel() { cancelled_ = true; }

 private:
  std::function<void(double)> report_;
  std::atomic<bool> cancelled_{false};
};

}  // namespace windfall::model
