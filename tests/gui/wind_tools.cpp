// Wind over time, fans, streaks, and trees moved while the time stands: in the real window, with real events.
#include <QPushButton>
#include <QTemporaryDir>
#include <QtTest>
#include <glm/geometric.hpp>

#include "support/suite.h"
#include "support/workspace_stage.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/scene/scene_workspace.h"
#include "widgets/scene/wind_curve_editor.h"

using namespace windfall;
using namespace windfall::widgets;

class WindToolsTest : public QObject, test::WorkspaceStage<SceneWorkspace> {
  Q_OBJECT

  const sim::WindSettings& wind() { return document_->project().scene.wind; }
  const sim::Statistics& statistics() { return workspace_->controller().last().statistics; }
  QPoint onScreen(vec3 place) {
    return workspace_->viewport().camera().project(place, workspace_->viewport().size())->toPoint();
  }
 private slots:
  void initTestCase() { QVERIFY(open({1000, 720})); }
  void cleanupTestCase() { close(); }
  void init() {
    document_->open(test::saplings(2), {});
    QVERIFY(window_->settle());
  }

  void curvePointsAreAddedDraggedDeletedAndUndone() {
    emit field<ChoiceField>("wind.course")->edited(1, true);
    QCOMPARE(wind().course, sim::WindCourse::Curve);
    auto* editor = field<WindCurveEditor>("wind.curve");
    QVERIFY(editor->isVisible());
    QTest::qWait(0);
    const std::size_t points = wind().curve.size();
    QVERIFY(points >= 3);

    QTest::mouseDClick(editor, Qt::LeftButton, {}, editor->place(3, 1.6, false).toPoint());
    QCOMPARE(wind().curve.size(), points + 1);
    QVERIFY(std::abs(wind().curve[1].time - 3) < 0.3f);
    QVERIFY(std::abs(wind().curve[1].strength - 1.6f) < 0.05f);

    drag(editor, editor->pointPlace(1, false).toPoint(), editor->place(4, 0.4, false).toPoint());
    QVERIFY(std::abs(wind().curve[1].time - 4) < 0.3f);
    QVERIFY(std::abs(wind().curve[1].strength - 0.4f) < 0.05f);
    // The lower lane turns the wind.
    drag(editor, editor->pointPlace(1, true).toPoint(), editor->place(4, 90, true).toPoint(), Qt::ShiftModifier);
    QVERIFY(std::abs(wind().curve[1].turn - 90) < 12);
    window_->grab().save(test::outputFolder() + "/wind_curve.png");

    editor->setFocus();
    QTest::keyClick(editor, Qt::Key_Delete);
    QCOMPARE(wind().curve.size(), points);
    // Course, addition, two drags of many moves each, deletion.
    QCOMPARE(document_->undoStack().count(), 5);
    document_->undoStack().undo();
    QCOMPARE(wind().curve.size(), points + 1);
    document_->undoStack().undo();
    document_->undoStack().undo();
    QVERIFY(std::abs(wind().curve[1].strength - 1.6f) < 0.05f);
    document_->undoStack().undo();
    QCOMPARE(wind().curve.size(), points);
    document_->undoStack().undo();
    QCOMPARE(wind().course, sim::WindCourse::Steady);
    QVERIFY(!editor->isVisible());
  }

  void recordedWindIsLoadedFromATableAndADamagedOneIsNamed() {
    QTemporaryDir folder;
    const auto write = [&](const QString& name, const QByteArray& text) {
      QFile file(folder.filePath(name));
      if (file.open(QIODevice::WriteOnly)) file.write(text);
      return file.fileName();
    };
    QSignalSpy messages(workspace_.get(), &Workspace::message);
    QVERIFY(workspace_->openFile(write("bad.csv", "time,speed,direction\n0,3,90\n1,x,90\n")));
    QCOMPARE(messages.size(), 1);
    QCOMPARE(messages[0][0].toString(), QString("bad.csv: line 3: the speed \"x\" is not a number"));
    QVERIFY(messages[0][1].toBool());
    QVERIFY(wind().records.empty());
    QVERIFY(workspace_->openFile(write("mast.csv", "time,speed,direction\n0,3,270\n10,9,300\n20,4,250\n")));
    QCOMPARE(wind().course, sim::WindCourse::Recorded);
    QCOMPARE(wind().records.size(), std::size_t{3});
    QVERIFY(field<InfoField>("wind.record")->value().startsWith("mast.csv"));
    document_->undoStack().undo();
    QCOMPARE(wind(), sim::WindSettings{.speed = 10});
  }

  void aFanIsPlacedMovedTurnedAndRemoved() {
    Viewport& view = workspace_->viewport();
    view.setFocus();
    QTest::keyClick(window_.get(), Qt::Key_F);
    const vec3 ground(-3.2f, 0, 0.8f);
    QTest::mouseClick(&view, Qt::LeftButton, {}, onScreen(ground));
    QCOMPARE(wind().fans.size(), std::size_t{1});
    const sim::Fan placed = wind().fans.front();
    QVERIFY(glm::length(placed.position - vec3(-3.2f, 2, 0.8f)) < 0.4f);
    QVERIFY(placed.direction.x > 0.5f);  // at the nearest tree
    QCOMPARE(workspace_->selection().fan(), 0);
    QVERIFY(field<NumberField>("fan.strength")->isVisibleTo(window_.get()));

    drag(&view, onScreen(placed.position), onScreen(placed.position) + QPoint(60, 0));
    const sim::Fan moved = wind().fans.front();
    QVERIFY(glm::length(moved.position - placed.position) > 0.3f);
    QVERIFY(std::abs(moved.position.y - placed.position.y) < 1e-4f);
    drag(&view, onScreen(moved.position), onScreen(moved.position) - QPoint(0, 40), Qt::ShiftModifier);
    const sim::Fan raised = wind().fans.front();
    QVERIFY(raised.position.y > moved.position.y + 0.2f);
    drag(&view, onScreen(fanTip(raised)), onScreen(fanTip(raised)) + QPoint(0, 30));
    QVERIFY(glm::dot(glm::normalize(wind().fans.front().direction), glm::normalize(raised.direction)) < 0.999f);
    emit field<NumberField>("fan.strength")->edited(25, true);
    QCOMPARE(wind().fans.front().strength, 25.f);
    QCoreApplication::processEvents();  // the fan's rows find their places
    window_->grab().save(test::outputFolder() + "/fan.png");

    QCOMPARE(document_->undoStack().count(), 5);
    document_->undoStack().undo();
    QCOMPARE(wind().fans.front().strength, sim::Fan().strength);
    document_->undoStack().undo();
    QCOMPARE(wind().fans.front(), raised);
    document_->undoStack().undo();
    document_->undoStack().undo();
    QCOMPARE(wind().fans.front(), placed);
    QTest::mouseClick(field<QPushButton>("fan.remove"), Qt::LeftButton);
    QVERIFY(wind().fans.empty());
    document_->undoStack().undo();
    QCOMPARE(wind().fans.size(), std::size_t{1});
    document_->undoStack().undo();
    QVERIFY(wind().fans.empty());
  }

  void aFanBendsTheTreeItBlowsAt() {
    sim::WindSettings calm = wind();
    calm.speed = 0;
    document_->setScene(&model::Scene::wind, calm, model::Aspect::Wind, "calm");
    const auto rest = pose();
    sim::Fan fan;
    fan.position = vec3(-5, 2.5f, 0);
    fan.strength = 30;
    fan.radius = 1.5f;
    calm.fans = {fan};
    document_->setScene(&model::Scene::wind, calm, model::Aspect::Wind, "fan");
    workspace_->controller().play();
    QTRY_VERIFY_WITH_TIMEOUT(statistics().time > 1.0, 30000);
    workspace_->controller().pause();
    QVERIFY(window_->settle());
    const auto blown = pose();
    float near = 0;
    const TreeSpan span = workspace_->feed().spans()[0];
    for (std::size_t i = span.firstLink; i < span.firstLink + span.linkCount; ++i) {
      near = std::max(near, glm::length(blown[i][0] - rest[i][0]));
    }
    QVERIFY2(near > 0.02f, qPrintable(QString::number(double(near))));
  }

  void streaksAreShownWhileItPlays() {
    QTest::keyClick(window_.get(), Qt::Key_W, Qt::ShiftModifier);
    QVERIFY(field<CheckField>("wind.streaks")->value());
    workspace_->controller().play();
    QTRY_VERIFY_WITH_TIMEOUT(statistics().time > 1.5, 30000);
    render::View view;
    workspace_->controller().describe(view);
    QVERIFY(!view.streaks.empty());
    float brightest = 0;
    for (const vec4& point : view.streaks) brightest = std::max(brightest, point.w);
    QVERIFY(brightest > 0.3f);
    workspace_->controller().pause();
    QVERIFY(window_->settle());
    window_->grab().save(test::outputFolder() + "/wind_streaks.png");
    QCOMPARE(workspace_->saveView()["streaks"].toBool(), true);
    QTest::keyClick(window_.get(), Qt::Key_W, Qt::ShiftModifier);
    QVERIFY(!field<CheckField>("wind.streaks")->value());
    QVERIFY(!document_->isModified());
  }

  void movingATreeWhileTheTimeStandsKeepsTimeAndPoses() {
    workspace_->controller().play();
    QTRY_VERIFY_WITH_TIMEOUT(statistics().time > 0.5, 30000);
    workspace_->controller().pause();
    QVERIFY(window_->settle());
    // A single step ends where it is shown; a pause may stand between two steps.
    workspace_->controller().step();
    QVERIFY(window_->settle());
    const double time = statistics().time;
    const auto before = pose();
    QVector3D place = document_->project().tree({2})->position;
    document_->setTree({2}, &model::TreePlacement::position, place + QVector3D(1, 0, 2), "Move");
    QVERIFY(window_->settle());
    QCOMPARE(statistics().time, time);
    const auto after = pose();
    const TreeSpan moved = workspace_->feed().spans()[0], other = workspace_->feed().spans()[1];
    for (std::size_t i = other.firstLink; i < other.firstLink + other.linkCount; ++i) {
      const float turned = glm::length(after[i][0] - before[i][0]), shifted = glm::length(after[i][3] - before[i][3]);
      QVERIFY2(turned < 5e-4f && shifted < 1e-3f, qPrintable(QStringLiteral("%1, %2 m").arg(turned).arg(shifted)));
    }
    // The moved one is bent as it was, somewhere else.
    const std::size_t tip = moved.firstLink + moved.linkCount - 1;
    QVERIFY(glm::length(after[tip][0] - before[tip][0]) < 5e-4f);
    QVERIFY(glm::length(vec3(after[tip][3] - before[tip][3]) - vec3(1, 0, 2)) < 1e-3f);

    // A third tree does not set the others back either.
    model::TreePlacement third;
    third.plant = {1};
    third.position = {0, 0, -4};
    document_->addTree(third);
    QVERIFY(window_->settle());
    QCOMPARE(workspace_->feed().spans().size(), std::size_t{3});
    QCOMPARE(statistics().time, time);
    const auto grown = pose();
    for (std::size_t i = other.firstLink; i < other.firstLink + other.linkCount; ++i) {
      QVERIFY(glm::length(grown[i][0] - before[i][0]) < 5e-4f);
    }
  }
};

WINDFALL_SUITE(WindToolsTest)
#include "wind_tools.moc"
