#include "widgets/viewport/picking.h"

#include <QtTest>
#include <glm/gtc/matrix_transform.hpp>

#include "support/suite.h"

using namespace windfall;
using namespace windfall::widgets;

class PickingTest : public QObject {
  Q_OBJECT
  const std::vector<LinkCapsule> capsules_{
      {{0, 0, 0}, {0, 2, 0}, 0.1f}, {{0, 2, 0}, {0, 4, 0}, 0.05f}, {{0, 2, 0}, {2, 3, 0}, 0.01f}};
  const std::vector<mat4> rest_{3, mat4(1)};

 private slots:
  void nearestLinkOnTheRayWins() {
    const auto hit = pick({{0, 1, 5}, {0, 0, -1}}, capsules_, rest_, 0);
    QVERIFY(hit);
    QCOMPARE(hit->link, std::size_t{0});
    QVERIFY(std::abs(hit->distance - 4.9f) < 1e-3f);
  }

  void missesWhatStandsBesideOrBehind() {
    QVERIFY(!pick({{1, 0.5f, 5}, {0, 0, -1}}, capsules_, rest_, 0));
    QVERIFY(!pick({{0, 1, 5}, {0, 0, 1}}, capsules_, rest_, 0));
  }

  void thinTwigIsMetWithSlackOnly() {
    const Ray beside{{1, 2.53f, 5}, {0, 0, -1}};
    QVERIFY(!pick(beside, capsules_, rest_, 0));
    const auto hit = pick(beside, capsules_, rest_, 0.01f);
    QVERIFY(hit);
    QCOMPARE(hit->link, std::size_t{2});
  }

  void whatIsMetWinsOverWhatIsNear() {
    const auto hit = pick({{0.04f, 2.05f, 5}, {0, 0, -1}}, capsules_, rest_, 0.05f);
    QVERIFY(hit);
    QVERIFY(hit->link != 2);
  }

  void poseMovesTheLinks() {
    std::vector<mat4> pose(3, glm::translate(mat4(1), vec3(3, 0, 0)));
    QVERIFY(!pick({{0, 1, 5}, {0, 0, -1}}, capsules_, pose, 0));
    QVERIFY(pick({{3, 1, 5}, {0, 0, -1}}, capsules_, pose, 0));
    const auto box = boundsOf(capsules_, pose);
    QVERIFY(box && std::abs(box->lower.x - 2.9f) < 1e-4f && std::abs(box->upper.x - 5.01f) < 1e-4f);
  }

  void capsulesFollowTheLinksAxis() {
    sim::Tree tree;
    sim::Link link;
    link.joint = {1, 2, 3};
    link.rotation = glm::angleAxis(-1.5707963f, vec3(1, 0, 0));  // +z to +y
    link.length = 2;
    link.radius = 0.1f;
    tree.links.push_back(link);
    const auto capsules = capsulesOf(tree);
    QVERIFY(glm::length(capsules[0].to - vec3(1, 4, 3)) < 1e-5f);
  }

  void groundIsMetInFrontOnly() {
    const auto place = meetGround({{0, 2, 0}, glm::normalize(vec3(1, -1, 0))}, 0);
    QVERIFY(place && std::abs(place->x - 2) < 1e-5f);
    QVERIFY(!meetGround({{0, 2, 0}, glm::normalize(vec3(1, 1, 0))}, 0));
    QVERIFY(!meetGround({{0, 2, 0}, vec3(1, 0, 0)}, 0));
  }

  void nothingToFrameWithoutLinks() { QVERIFY(!boundsOf({}, {})); }
};

WINDFALL_SUITE(PickingTest)
#include "picking.moc"
