#include "model/plant/live_edits.h"

#include <QtTest>

#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

class LiveEditsTest : public QObject {
  Q_OBJECT
 private slots:
  void editsGoToTheirLinksAndOthersToDefaults() {
    PlantGeometry geometry;
    geometry.bones.resize(3);
    for (int i = 0; i < 3; ++i) geometry.bones[static_cast<std::size_t>(i)].name = QString("bone %1").arg(i);
    PlantBodies bodies;
    bodies.boneOfLink = {2, 0};
    sim::Tree tree;
    tree.links.resize(2);
    tree.links[1].stiffnessScale = 9;
    tree.links[1].length = 3;
    LinkAttributes attributes;
    attributes.stiffness = 2.5;
    attributes.damping = 0.5;
    attributes.windResponse = 3;
    attributes.woodDensity = 700;
    attributes.youngsModulus = 8e9;
    const auto edited = withEdits(tree, geometry, bodies, {{"bone 2", attributes}, {"bone 1", attributes}});
    QCOMPARE(edited->links[0].stiffnessScale, 2.5f);
    QCOMPARE(edited->links[0].dampingScale, 0.5f);
    QCOMPARE(edited->links[0].windScale, 3.f);
    QCOMPARE(edited->links[0].woodDensity, 700.f);
    QCOMPARE(edited->links[0].youngsModulus, 8e9f);
    QCOMPARE(edited->links[1].stiffnessScale, 1.f);
    QCOMPARE(edited->links[1].length, 3.f);
    QCOMPARE(tree.links[1].stiffnessScale, 9.f);
  }
};

WINDFALL_SUITE(LiveEditsTest)
#include "live_edits.moc"
