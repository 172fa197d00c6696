#include "widgets/plant/branch_model.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>
#include <QtTest>

#include "support/suite.h"

using namespace windfall;
using namespace windfall::widgets;

namespace {

/// A trunk of three bones, and `limbs` limbs of two that leave it. Bone 0 became no link.
model::LoadedPlant makePlant(int limbs) {
  auto geometry = std::make_shared<model::PlantGeometry>();
  auto bodies = std::make_shared<model::PlantBodies>();
  const auto addBranch = [&](const QString& name, int parent, int order, int bones) {
    model::Branch branch;
    branch.name = name;
    branch.parent = parent;
    branch.order = order;
    branch.length = bones;
    for (int i = 0; i < bones; ++i) {
      model::Bone bone;
      bone.name = QString("%1.%2").arg(name).arg(i);
      bone.tail = {0, 1, 0};
      branch.bones.push_back(static_cast<int>(geometry->bones.size()));
      geometry->bones.push_back(bone);
    }
    bodies->branches.push_back(branch);
  };
  addBranch("Trunk", -1, 0, 3);
  for (int i = 0; i < limbs; ++i) addBranch(QString("Limb %1").arg(i), 0, 1, 2);
  bodies->linkOfBone.push_back(-1);
  for (std::size_t i = 1; i < geometry->bones.size(); ++i) {
    bodies->linkOfBone.push_back(static_cast<int>(i) - 1);
    bodies->boneOfLink.push_back(static_cast<int>(i));
  }
  return {geometry, bodies};
}

}  // namespace

class BranchModelTest : public QObject {
  Q_OBJECT

 private slots:
  void isASoundItemModel() {
    BranchModel model;
    QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
    model.setPlant(makePlant(5));
    model.setPlant({});
    model.setPlant(makePlant(2));
  }

  void branchOpensIntoBranchesThenLinks() {
    BranchModel model;
    model.setPlant(makePlant(2));
    QCOMPARE(model.rowCount(), 1);
    const QModelIndex trunk = model.index(0, 0);
    QCOMPARE(trunk.data().toString(), "Trunk");
    QCOMPARE(model.rowCount(trunk), 5);
    QCOMPARE(model.index(1, 0, trunk).data().toString(), "Limb 1");
    QCOMPARE(model.index(2, 0, trunk).data().toString(), "Trunk.0");
    QCOMPARE(model.rowCount(model.index(2, 0, trunk)), 0);
    QCOMPARE(model.branchAt(model.index(1, 0, trunk)), 2);
    QCOMPARE(model.branchAt(model.index(2, 0, trunk)), -1);
  }

  void rowsNameTheirLinks() {
    BranchModel model;
    model.setPlant(makePlant(2));
    const QModelIndex trunk = model.index(0, 0);
    QCOMPARE(model.links(trunk), (std::vector<std::size_t>{0, 1}));  // its first bone has none
    QCOMPARE(model.links(model.index(2, 0, trunk)), std::vector<std::size_t>{});
    QCOMPARE(model.links(model.branchIndex(2)), (std::vector<std::size_t>{4, 5}));
    QCOMPARE(model.branchOfLink(5), model.branchIndex(2));
    QVERIFY(!model.branchOfLink(99).isValid());
  }

  void editedBonesMarkTheirBranchToo() {
    BranchModel model;
    model.setPlant(makePlant(2));
    QSignalSpy changed(&model, &QAbstractItemModel::dataChanged);
    model.setEdited({"Limb 0.1"});
    QCOMPARE(changed.size(), 2);
    QVERIFY(model.branchIndex(1).data(Qt::FontRole).value<QFont>().bold());
    QVERIFY(!model.branchIndex(2).data(Qt::FontRole).isValid());
    model.setEdited({"Limb 0.1"});
    QCOMPARE(changed.size(), 2);
    model.setEdited({});
    QVERIFY(!model.branchIndex(1).data(Qt::FontRole).isValid());
  }

  void tensOfThousandsOfRowsAreNotWalked() {
    BranchModel model;
    model.setPlant(makePlant(20000));
    QCOMPARE(model.rowCount(model.index(0, 0)), 20003);
    QCOMPARE(model.links(model.branchIndex(20000)).size(), std::size_t{2});
  }
};

WINDFALL_SUITE(BranchModelTest)
#include "branch_model.moc"
