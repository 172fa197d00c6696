// Long work off the GUI thread: a value snapshot in, progress and cancel, the result back on the GUI thread.
#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <vector>

#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model {

/// One running piece of work, as the window shows it.
class Job : public QObject {
  Q_OBJECT
 public:
  QString title() const { return title_; }
  double fraction() const;
  void cancel();
  bool isCancelled() const;

 signals:
  void progressed(double fraction);
  /// Emitted once, on the GUI thread, after the result was applied, dropped or failed.
  void finished();

 private:
  friend class JobRunner;
  QString title_;
  QString slot_;
  std::shared_ptr<Progress> progress_;
  std::atomic<double> fraction_{0};
};

/// Starts jobs on a thread pool of its own. A job with the same `slot` as a running one makes that one stale: it is
/// cancelled and its result dropped.
class JobRunner : public QObject {
  Q_OBJECT
 public:
  explicit JobRunner(QObject* parent = nullptr);
  ~JobRunner() override;

  /// `work` runs elsewhere and must own all that it touches; `apply` runs on the GUI thread if it succeeded and is not
  /// stale. An error goes to `failed`, unless it was cancelled.
  template <class T>
  Job* start(const QString& title, const QString& slot, std::function<Result<T>(Progress&)> work,
             std::function<void(T)> apply);

  std::vector<Job*> running() const;
  void cancelAll();
  /// Runs the event loop until nothing runs any more (tests, closing).
  void waitForAll();

 signals:
  void started(windfall::model::Job* job);
  void failed(const QString& title, const QString& message);

 private:
  Job* launch(const QString& title, const QString& slot, std::function<std::function<void()>(Progress&)> work);
  struct State;
  std::unique_ptr<State> state_;
};

template <class T>
Job* JobRunner::start(const QString& title, const QString& slot, std::function<Result<T>(Progress&)> work,
                      std::function<void(T)> apply) {
  return launch(title, slot, [this, title, work = std::move(work), apply = std::move(apply)](Progress& progress) {
    auto result = std::make_shared<Result<T>>(work(progress));
    return std::function<void()>([this, title, result, apply] {
      if (*result) {
        apply(std::move(**result));
      } else if (!result->error().cancelled) {
        emit failed(title, QString::fromStdString(result->error().message));
      }
    });
  });
}

}  // namespace windfall::model
