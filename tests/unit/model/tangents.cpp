#include <QtTest>

#include "model/export/tangents.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

/// Tangents of a square whose picture is turned, mirrored or crushed.
class TangentsTest : public QObject {
  Q_OBJECT

  static std::vector<vec4> ofSquare(const std::vector<vec2>& uvs) {
    const std::vector<vec3> square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, normals(4, vec3(0, 0, 1));
    const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
    return tangentsOf(square, normals, uvs, indices);
  }

 private slots:
  void theyFollowThePicture_data() {
    QTest::addColumn<QList<QPointF>>("uvs");
    QTest::addColumn<QList<double>>("expected");
    // v runs down a picture: its upper border has v = 0.
    QTest::newRow("upright") << QList<QPointF>{{0, 1}, {1, 1}, {1, 0}, {0, 0}} << QList<double>{1, 0, 0, 1};
    QTest::newRow("a quarter turn") << QList<QPointF>{{0, 0}, {0, 1}, {1, 1}, {1, 0}} << QList<double>{0, 1, 0, 1};
    QTest::newRow("mirrored") << QList<QPointF>{{1, 1}, {0, 1}, {0, 0}, {1, 0}} << QList<double>{-1, 0, 0, -1};
  }
  void theyFollowThePicture() {
    QFETCH(QList<QPointF>, uvs);
    QFETCH(QList<double>, expected);
    std::vector<vec2> given;
    for (const QPointF& uv : uvs) given.emplace_back(uv.x(), uv.y());
    for (const vec4& tangent : ofSquare(given)) {
      for (int k = 0; k < 4; ++k) QVERIFY(std::abs(static_cast<double>(tangent[k]) - expected[k]) < 1e-6);
    }
  }
  void crushedPicturesStillGiveUnitTangents() {
    for (const vec4& tangent : ofSquare({{0, 0}, {0, 0}, {0, 0}, {0, 0}})) {
      QVERIFY(std::abs(glm::length(vec3(tangent)) - 1) < 1e-6f);
      QCOMPARE(tangent.z, 0.f);
      QCOMPARE(std::abs(tangent.w), 1.f);
    }
  }
};

WINDFALL_SUITE(TangentsTest)
#include "tangents.moc"
