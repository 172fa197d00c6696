// Jobs: results come back on the GUI thread, stale and cancelled ones do not.
#include "model/document/job.h"

#include <QSignalSpy>
#include <QThread>
#include <QtTest>
#include <algorithm>
#include <semaphore>
#include <stdexcept>

#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

/// Runs until somebody cancels it.
Result<int> untilCancelled(Progress& progress) {
  while (!progress.cancelled()) QThread::yieldCurrentThread();
  return Error{"cancelled", true};
}

}  // namespace

class JobTest : public QObject {
  Q_OBJECT
 private slots:
  void theResultIsAppliedOnTheGuiThread();
  void errorsAreReportedOnce();
  void anExceptionIsAnError();
  void aNewerJobOfTheSlotMakesTheOlderStale();
  void aCancelledJobAppliesNothingEvenIfItWasDone();
  void progressReachesTheJobInOrder();
  void theRunnerEndsItsJobsWhenItDies();
};

void JobTest::theResultIsAppliedOnTheGuiThread() {
  JobRunner runner;
  QThread *worked = nullptr, *applied = nullptr;
  int value = 0;
  QSignalSpy started(&runner, &JobRunner::started);
  Job* job = runner.start<int>(
      "Sum", "sum",
      [&](Progress&) -> Result<int> {
        worked = QThread::currentThread();
        return 42;
      },
      [&](int result) {
        applied = QThread::currentThread();
        value = result;
      });
  QCOMPARE(job->title(), QString("Sum"));
  QSignalSpy finished(job, &Job::finished);
  QCOMPARE(runner.running().size(), size_t(1));
  runner.waitForAll();
  QCOMPARE(value, 42);
  QCOMPARE(applied, QThread::currentThread());
  QVERIFY(worked != applied);
  QCOMPARE(started.count(), 1);
  QCOMPARE(finished.count(), 1);
  QVERIFY(runner.running().empty());
}

void JobTest::errorsAreReportedOnce() {
  JobRunner runner;
  QSignalSpy failed(&runner, &JobRunner::failed);
  bool applied = false;
  runner.start<int>(
      "Mask", {}, [](Progress&) -> Result<int> { return Error{"no leaf found"}; }, [&](int) { applied = true; });
  runner.waitForAll();
  QVERIFY(!applied);
  QCOMPARE(failed.count(), 1);
  QCOMPARE(failed.at(0).at(0).toString(), QString("Mask"));
  QCOMPARE(failed.at(0).at(1).toString(), QString("no leaf found"));
}

void JobTest::anExceptionIsAnError() {
  JobRunner runner;
  QSignalSpy failed(&runner, &JobRunner::failed);
  runner.start<int>(
      "Atlas", {}, [](Progress&) -> Result<int> { throw std::runtime_error("too large"); }, [](int) {});
  runner.waitForAll();
  QCOMPARE(failed.count(), 1);
  QCOMPARE(failed.at(0).at(1).toString(), QString("too large"));
}

void JobTest::aNewerJobOfTheSlotMakesTheOlderStale() {
  JobRunner runner;
  QSignalSpy failed(&runner, &JobRunner::failed);
  std::vector<int> applied;
  const auto keep = [&](int value) { applied.push_back(value); };
  runner.start<int>("Old", "leaf 1", untilCancelled, keep);
  runner.start<int>(
      "New", "leaf 1", [](Progress&) -> Result<int> { return 2; }, keep);
  runner.start<int>(
      "Other", "leaf 2", [](Progress&) -> Result<int> { return 3; }, keep);
  runner.waitForAll();
  std::sort(applied.begin(), applied.end());
  QCOMPARE(applied, (std::vector<int>{2, 3}));
  QCOMPARE(failed.count(), 0);
}

void JobTest::aCancelledJobAppliesNothingEvenIfItWasDone() {
  JobRunner runner;
  bool applied = false;
  std::binary_semaphore done(0);
  Job* job = runner.start<int>(
      "Late", {},
      [&](Progress&) -> Result<int> {
        done.release();
        return 1;
      },
      [&](int) { applied = true; });
  done.acquire();
  job->cancel();
  runner.waitForAll();
  QVERIFY(!applied);
}

void JobTest::progressReachesTheJobInOrder() {
  JobRunner runner;
  std::vector<double> seen;
  Job* job = runner.start<int>(
      "Count", {},
      [](Progress& progress) -> Result<int> {
        for (int i = 1; i <= 10000; ++i) progress.report(i / 10000.0);
        return 1;
      },
      [](int) {});
  connect(job, &Job::progressed, this, [&](double fraction) { seen.push_back(fraction); });
  runner.waitForAll();
  QVERIFY(std::is_sorted(seen.begin(), seen.end()));
  QVERIFY(!seen.empty());
  QVERIFY(seen.size() <= 220);
  QCOMPARE(seen.back(), 1.0);
}

void JobTest::theRunnerEndsItsJobsWhenItDies() {
  bool applied = false;
  {
    JobRunner runner;
    for (int i = 0; i < 5; ++i) runner.start<int>("Endless", {}, untilCancelled, [&](int) { applied = true; });
  }
  QCoreApplication::processEvents();
  QVERIFY(!applied);
}

WINDFALL_SUITE(JobTest)
#include "job.moc"
