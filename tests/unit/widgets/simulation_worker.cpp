#include "widgets/scene/simulation_worker.h"

#include <QtTest>

#include "sim/sample_tree.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::widgets;

namespace {

sim::SceneDescription makeScene() {
  sim::SampleTreeSettings settings;
  settings.orders = 2;
  settings.leaves = false;
  sim::SceneDescription scene;
  scene.trees.push_back({std::make_shared<sim::Tree>(sim::sampleTree(settings)), {}});
  scene.wind.speed = 12;
  scene.leaves.count = 0;
  return scene;
}

FrameTask newEngine() {
  FrameTask task;
  task.engine = EngineRequest{makeScene(), sim::Device::Cpu, {}, false};
  return task;
}

FrameTask motion(Motion kind, double elapsed = 0) {
  FrameTask task;
  task.motion = kind;
  task.elapsed = elapsed;
  return task;
}

}  // namespace

class SimulationWorkerTest : public QObject {
  Q_OBJECT
 private slots:
  void withoutASceneThereIsNoFrame() {
    SimulationWorker worker;
    const FrameResult result = worker.run(motion(Motion::Step));
    QVERIFY(!result.hasEngine && !result.written);
    QVERIFY(worker.saveState().empty());
  }

  void aSceneThatCannotBeIsAProblemNotACrash() {
    SimulationWorker worker;
    FrameTask task = newEngine();
    task.engine->scene.solver.step = -1;
    const FrameResult result = worker.run(std::move(task));
    QVERIFY(!result.hasEngine);
    QVERIFY(!result.problem.empty());
  }

  void advancesByRealTimeAndReportsWhatItLost() {
    SimulationWorker worker;
    worker.run(newEngine());
    FrameResult result = worker.run(motion(Motion::Advance, 0.055));
    QCOMPARE(result.advance.steps, 3);
    QCOMPARE(result.advance.lost, 0.0);
    result = worker.run(motion(Motion::Advance, 1));
    QCOMPARE(result.advance.steps, 8);
    QVERIFY(result.advance.lost > 0.8);
  }

  void writesIntoTheSlotAndHandsTheSamePoseOut() {
    SimulationWorker worker;
    const FrameResult made = worker.run(newEngine());
    QVERIFY(made.madeEngine);
    std::vector<mat4> bones(made.linkCount, mat4(0));
    std::vector<LeafInstance> leaves(made.leafCount);
    worker.run(motion(Motion::Advance, 0.1));
    FrameTask task;
    task.slot = {0, bones, leaves};
    task.wantPose = true;
    const FrameResult result = worker.run(std::move(task));
    QVERIFY(result.written);
    QVERIFY(result.pose == bones);
    QVERIFY(bones[0] != mat4(0));
  }

  void slotOfAnotherSizeIsLeftAlone() {
    SimulationWorker worker;
    worker.run(newEngine());
    std::vector<mat4> bones(3, mat4(7));
    FrameTask task;
    task.slot = {0, bones, {}};
    QVERIFY(!worker.run(std::move(task)).written);
    QCOMPARE(bones[2], mat4(7));
  }

  void stateComesBackInANewEngine() {
    SimulationWorker worker;
    worker.run(newEngine());
    worker.run(motion(Motion::Advance, 0.1));
    const auto state = worker.saveState();
    SimulationWorker other;
    FrameTask task = newEngine();
    task.engine->state = state;
    const FrameResult result = other.run(std::move(task));
    QVERIFY(result.problem.empty());
    QVERIFY(result.statistics.time > 0.05);
    QCOMPARE(other.saveState(), state);
  }

  void damagedStateIsToldAndTheSceneStartsAnew() {
    SimulationWorker worker;
    FrameTask task = newEngine();
    task.engine->state = {1, 2, 3};
    const FrameResult result = worker.run(std::move(task));
    QVERIFY(result.hasEngine);
    QVERIFY(!result.problem.empty());
    QCOMPARE(result.statistics.time, 0.0);
  }

  void liveWindBendsTheTreesFarther() {
    const auto bend = [](float speed) {
      SimulationWorker worker;
      const FrameResult made = worker.run(newEngine());
      std::vector<mat4> bones(made.linkCount);
      FrameTask task;
      task.wind = sim::WindSettings{.speed = speed, .turbulence = 0, .gustStrength = 0};
      worker.run(std::move(task));
      for (int i = 0; i < 12; ++i) worker.run(motion(Motion::Advance, 0.1));
      FrameTask last;
      last.slot = {0, bones, {}};
      return worker.run(std::move(last)).statistics.tipDisplacement;
    };
    const float breeze = bend(3), gale = bend(18);
    QVERIFY2(breeze > 0 && gale > 3 * breeze, qPrintable(QString("%1 %2").arg(double(breeze)).arg(double(gale))));
  }

  void anotherDeviceKeepsTheMotion() {
    SimulationWorker worker;
    worker.run(newEngine());
    worker.run(motion(Motion::Advance, 0.1));
    FrameTask task = newEngine();
    task.engine->keepMotion = true;
    QVERIFY(worker.run(std::move(task)).statistics.time > 0.05);
    QCOMPARE(worker.run(motion(Motion::Reset)).statistics.time, 0.0);
  }
};

WINDFALL_SUITE(SimulationWorkerTest)
#include "simulation_worker.moc"
