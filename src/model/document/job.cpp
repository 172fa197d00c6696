#include "model/document/job.h"

#include <QCoreApplication>
#include <QThreadPool>
#include <condition_variable>
#include <exception>
#include <mutex>

namespace windfall::model {

namespace {

/// Reports that moved less than this are kept but not signalled: a slot a thousandth would drown the GUI thread.
constexpr double kVisibleStep = 0.005;

/// Counts work that is on the pool, so that the runner can outlive it.
class Latch {
 public:
  void enter() {
    const std::lock_guard lock(mutex_);
    ++count_;
  }
  void leave() {
    // Signalled under the lock: the waiter may destroy the latch as soon as it sees zero.
    const std::lock_guard lock(mutex_);
    if (--count_ == 0) empty_.notify_all();
  }
  void wait() {
    std::unique_lock lock(mutex_);
    empty_.wait(lock, [this] { return count_ == 0; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable empty_;
  int count_ = 0;
};

}  // namespace

double Job::fraction() const { return fraction_; }
void Job::cancel() { progress_->cancel(); }
bool Job::isCancelled() const { return progress_->cancelled(); }

struct JobRunner::State {
  /// Jobs may wait for threads that they start. Qt's painter shares its work out to the global pool and waits for it,
  /// so a job that held a place there while it waited for a painter would wait for itself.
  QThreadPool pool;
  std::vector<Job*> jobs;
  Latch working;
};

JobRunner::JobRunner(QObject* parent) : QObject(parent), state_(std::make_unique<State>()) {}

JobRunner::~JobRunner() {
  cancelAll();
  state_->working.wait();
  // Results that were posted meanwhile die with this object, the jobs are its children.
}

Job* JobRunner::launch(const QString& title, const QString& slot,
                       std::function<std::function<void()>(Progress&)> work) {
  if (!slot.isEmpty()) {
    for (Job* other : state_->jobs) {
      if (other->slot_ == slot) other->cancel();
    }
  }
  auto* job = new Job;
  job->setParent(this);
  job->title_ = title;
  job->slot_ = slot;
  // Jobs live until their end was delivered to this thread, so a worker may point to its own.
  job->progress_ = std::make_shared<Progress>([job, shown = std::make_shared<std::atomic<double>>(0)](double fraction) {
    job->fraction_ = fraction;
    if (fraction - *shown < kVisibleStep && fraction < 1) return;
    *shown = fraction;
    QMetaObject::invokeMethod(
        job, [job, fraction] { emit job->progressed(fraction); }, Qt::QueuedConnection);
  });
  state_->jobs.push_back(job);
  state_->working.enter();
  state_->pool.start([this, job, title, progress = job->progress_, work = std::move(work)]() mutable {
    std::function<void()> deliver;
    if (!progress->cancelled()) {
      try {
        deliver = work(*progress);
      } catch (const std::exception& exception) {
        const QString message = QString::fromLocal8Bit(exception.what());
        deliver = [this, title, message] { emit failed(title, message); };
      }
    }
    work = nullptr;  // the snapshot is freed here, not on the GUI thread
    QMetaObject::invokeMethod(
        this,
        [this, job, deliver = std::move(deliver)] {
          std::erase(state_->jobs, job);
          // Cancelled after it was done, or stale: nobody waits for this result.
          if (deliver && !job->progress_->cancelled()) deliver();
          emit job->finished();
          job->deleteLater();
        },
        Qt::QueuedConnection);
    state_->working.leave();
  });
  emit started(job);
  return job;
}

std::vector<Job*> JobRunner::running() const { return state_->jobs; }

void JobRunner::cancelAll() {
  for (Job* job : state_->jobs) job->cancel();
}

void JobRunner::waitForAll() {
  while (!state_->jobs.empty()) QCoreApplication::processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents);
}

}  // namespace windfall::model
