#include "app/cli/interrupt.h"

#include <atomic>
#include <csignal>

namespace windfall::app {

namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

extern "C" void windfallInterrupt(int) { interrupted = true; }

}  // namespace

InterruptProgress::InterruptProgress() {
  interrupted = false;
  std::signal(SIGINT, windfallInterrupt);
  std::signal(SIGTERM, windfallInterrupt);
}

InterruptProgress::~InterruptProgress() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool InterruptProgress::cancelled() const { return interrupted || Progress::cancelled(); }

}  // namespace windfall::app
