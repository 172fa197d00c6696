#include <QtTest>

#include "support/painted_leaf.h"
#include "support/suite.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/leaf/leaf_inspector.h"

using namespace windfall;
using namespace windfall::widgets;

class LeafInspectorTest : public QObject {
  Q_OBJECT

  model::Document document_;
  std::unique_ptr<LeafInspector> inspector_;
  model::AssetId leaf_;

  const model::SynthesisParameters& synthesis() { return document_.project().leaf(leaf_)->parameters.synthesis; }
  void type(const char* id, const QString& text) {
    NumberBox* box = inspector_->number(QLatin1String(id))->box();
    box->setFocus();
    box->selectAll();
    QTest::keyClicks(box, text);
    QTest::keyClick(box, Qt::Key_Return);
  }

 private slots:
  void init() {
    document_.open({}, {});
    leaf_ = document_.addLeaf(test::paintedLeaf());
    inspector_ = std::make_unique<LeafInspector>(document_);
    inspector_->setLeaf(leaf_);
    inspector_->resize(360, 2000);
    inspector_->show();
    QVERIFY(QTest::qWaitForWindowExposed(inspector_.get()));
  }
  void cleanup() { inspector_.reset(); }

  void eachMethodShowsItsOwnNumbers() {
    QVERIFY(synthesis().guided);
    QVERIFY(inspector_->number("synthesis.guideWeight")->isVisible());
    QVERIFY(!inspector_->number("synthesis.levels")->isVisible());
    model::LeafParameters classic = document_.project().leaf(leaf_)->parameters;
    classic.synthesis.guided = false;
    document_.setLeaf(leaf_, &model::Leaf::parameters, classic, model::Aspect::LeafParameters, "classic");
    QVERIFY(!inspector_->number("synthesis.guideWeight")->isVisible());
    for (const char* id : {"superpixels", "levels", "candidates", "choices", "smoothing"}) {
      QVERIFY(inspector_->number(QStringLiteral("synthesis.") + id)->isVisible());
    }
    QVERIFY(inspector_->check("synthesis.detail")->isVisible());
  }
  void typedNumbersAreEditsWithUndo() {
    const model::LeafParameters before = document_.project().leaf(leaf_)->parameters;
    type("synthesis.guideWeight", "250");
    QCOMPARE(synthesis().guideWeight, 250.0);
    type("synthesis.variety", "7.5");
    QCOMPARE(synthesis().variety, 7.5);
    type("regions.evenTones", "40");
    QCOMPARE(document_.project().leaf(leaf_)->parameters.regions.evenTones, 0.4);
    model::LeafParameters classic = document_.project().leaf(leaf_)->parameters;
    classic.synthesis.guided = false;
    document_.setLeaf(leaf_, &model::Leaf::parameters, classic, model::Aspect::LeafParameters, "classic");
    type("synthesis.levels", "5");
    type("synthesis.choices", "4");
    QTest::mouseClick(inspector_->check("synthesis.detail")->box(), Qt::LeftButton);
    QCOMPARE(synthesis().levels, 5);
    QCOMPARE(synthesis().choices, 4);
    QVERIFY(!synthesis().detail);
    while (document_.undoStack().index() > 1) document_.undoStack().undo();
    QCOMPARE(document_.project().leaf(leaf_)->parameters, before);
    QCOMPARE(inspector_->number("synthesis.levels")->value(), double(before.synthesis.levels));
  }
};

WINDFALL_SUITE(LeafInspectorTest)
#include "leaf_inspector.moc"
