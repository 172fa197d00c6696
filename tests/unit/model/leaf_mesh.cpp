// Leaf meshes fit their texture, fold without stretching, and get coarser level by level.
#include "model/leaf/leaf_mesh.h"

#include <QPainter>
#include <QtTest>
#include <cmath>
#include <glm/geometric.hpp>

#include "model/leaf/atlas.h"
#include "model/leaf/leaf_hull_private.h"
#include "model/leaf/triangulation.h"
#include "model/sample/leaf_painter.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

LeafTexture texture(LeafShape shape, quint64 seed, int size = 400) {
  const PaintedPhoto painted = paintLeafPhoto({shape, 0.3, 0.5}, seed, size);
  QImage image = painted.photo.convertToFormat(QImage::Format_RGBA8888);
  image.setAlphaChannel(painted.mask);
  return uprightTexture(QStringLiteral("leaf"), image, painted.root, painted.tip, 0.08);
}

LeafMeshes fitted(const LeafTexture& from) {
  const Result<LeafMeshes> meshes = fitLeafMeshes({from.image, from.pivot, {}});
  return meshes ? *meshes : LeafMeshes{};
}

/// Signed area of a triangle in leaf lengths.
double area(const LeafMesh& mesh, size_t first) {
  const vec2 a = mesh.vertices[mesh.indices[first]].place, b = mesh.vertices[mesh.indices[first + 1]].place,
             c = mesh.vertices[mesh.indices[first + 2]].place;
  return 0.5 * double((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

/// Share of leaf and mesh that is both, by drawing the triangles over the texture.
double overlapWith(const LeafMesh& mesh, const QImage& image) {
  QImage drawn(image.size(), QImage::Format_Grayscale8);
  drawn.fill(0);
  QPainter painter(&drawn);
  painter.setPen(Qt::NoPen);
  painter.setBrush(Qt::white);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    QPolygonF triangle;
    for (size_t k = 0; k < 3; ++k) {
      const vec2 uv = mesh.vertices[mesh.indices[i + k]].uv;
      triangle << QPointF(double(uv.x) * image.width(), double(uv.y) * image.height());
    }
    painter.drawPolygon(triangle);
  }
  painter.end();
  qint64 both = 0, either = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const bool leaf = qAlpha(image.pixel(x, y)) >= 128, mesh1 = qGray(drawn.pixel(x, y)) > 127;
      both += leaf && mesh1;
      either += leaf || mesh1;
    }
  }
  return double(both) / double(std::max<qint64>(1, either));
}

}  // namespace

class LeafMeshTest : public QObject {
  Q_OBJECT
 private slots:
  void shapes_data() {
    QTest::addColumn<int>("shape");
    for (int i = 0; i <= int(LeafShape::Maple); ++i) QTest::addRow("shape %d", i) << i;
  }

  void noTriangleIsFlippedAndTheFinestFits_data() { shapes_data(); }
  void noTriangleIsFlippedAndTheFinestFits() {
    QFETCH(int, shape);
    const LeafTexture from = texture(LeafShape(shape), 3);
    const LeafMeshes meshes = fitted(from);
    for (const LeafMesh& mesh : meshes) {
      QVERIFY(!mesh.indices.empty());
      for (size_t i = 0; i < mesh.indices.size(); i += 3) QVERIFY(area(mesh, i) > 0);
    }
    const double finest = overlapWith(meshes[0], from.image), coarse = overlapWith(meshes[1], from.image);
    QVERIFY2(finest >= 0.99, qPrintable(QString::number(finest)));
    QVERIFY2(coarse >= 0.90, qPrintable(QString::number(coarse)));
    const size_t triangles[] = {meshes[0].indices.size() / 3, meshes[1].indices.size() / 3,
                                meshes[2].indices.size() / 3, meshes[3].indices.size() / 3};
    QVERIFY2(triangles[0] >= 60 && triangles[0] <= 400, qPrintable(QString::number(triangles[0])));
    QVERIFY(triangles[1] < triangles[0] / 2);
    QVERIFY(triangles[2] <= 6);
    QCOMPARE(triangles[3], size_t(2));
  }

  void theHullHoldsTheWholeLeaf() {
    const LeafTexture from = texture(LeafShape::Oak, 5);
    const LeafMesh hull = fitted(from)[2];
    QVERIFY(hull.vertices.size() <= 8);
    Polygon corners;
    for (const LeafVertex& v : hull.vertices) {
      corners.emplace_back(double(v.uv.x) * from.image.width(), double(v.uv.y) * from.image.height());
    }
    corners = enclosingPolygon(corners, 8, 0);
    for (int y = 0; y < from.image.height(); ++y) {
      for (int x = 0; x < from.image.width(); ++x) {
        if (qAlpha(from.image.pixel(x, y)) >= 128) QVERIFY(contains(corners, QPointF(x + 0.5, y + 0.5)));
      }
    }
  }

  void thePetiolesEndIsTheOriginAndTheTipOneAway() {
    const LeafMesh mesh = fitted(texture(LeafShape::Ovate, 2))[0];
    float low = 1e9f, high = -1e9f, nearest = 1e9f;
    for (const LeafVertex& v : mesh.vertices) {
      low = std::min(low, v.place.y);
      high = std::max(high, v.place.y);
      nearest = std::min(nearest, glm::length(v.place));
    }
    QVERIFY(std::abs(low) < 0.02f && std::abs(high - 1) < 0.02f);
    QVERIFY(nearest < 0.02f);
  }

  void bendingKeepsLengths_data() {
    QTest::addColumn<float>("dryness");
    for (const float dryness : {0.f, 0.35f, 0.7f, 1.f}) QTest::addRow("dryness %.2f", double(dryness)) << dryness;
  }
  void bendingKeepsLengths() {
    QFETCH(float, dryness);
    LeafBend shape = bendOf(dryness, 0.3f, 0.15f, 0.4f);
    shape.ripple = 0;
    const auto length = [&](auto at) {
      double sum = 0;
      constexpr int kSteps = 400;
      for (int i = 0; i < kSteps; ++i) {
        sum += double(
            glm::length(bend(at(float(i + 1) / kSteps), shape).position - bend(at(float(i) / kSteps), shape).position));
      }
      return sum;
    };
    for (const float y : {0.2f, 0.6f, 0.95f}) {
      const double across = length([y](float t) {
        const float x = -0.4f + 0.8f * t;
        return LeafVertex{{x, y}, x, {}};
      });
      QVERIFY2(std::abs(across - 0.8) < 0.008, qPrintable(QString::number(across)));
    }
    const double along = length([](float t) { return LeafVertex{{0, t}, 0, {}}; });
    QVERIFY2(std::abs(along - 1) < 0.01, qPrintable(QString::number(along)));
    // The mesh itself, whose inner row lies half-way: its chords lose little.
    double meshed = 0;
    const float xs[] = {-0.4f, -0.2f, 0, 0.2f, 0.4f};
    for (int i = 0; i < 4; ++i) {
      meshed += double(glm::length(bend({{xs[i + 1], 0.6f}, xs[i + 1], {}}, shape).position -
                                   bend({{xs[i], 0.6f}, xs[i], {}}, shape).position));
    }
    QVERIFY2(std::abs(meshed - 0.8) < 0.008, qPrintable(QString::number(meshed)));
  }

  void bentNormalsStandOnTheSurface() {
    LeafBend shape = bendOf(0.5f, 0, 0.1f, 0.4f);
    shape.ripple = 0;
    const float e = 1e-3f;
    for (const float x : {-0.3f, -0.15f, 0.15f, 0.3f}) {
      const LeafVertex at{{x, 0.6f}, x, {}};
      const vec3 dx =
          bend({{x + e, 0.6f}, x + e, {}}, shape).position - bend({{x - e, 0.6f}, x - e, {}}, shape).position;
      const vec3 dy = bend({{x, 0.6f + e}, x, {}}, shape).position - bend({{x, 0.6f - e}, x, {}}, shape).position;
      const vec3 normal = glm::normalize(glm::cross(dx, dy));
      QVERIFY(glm::dot(normal, bend(at, shape).normal) > 0.99f);
    }
  }

  void aCurvedMidribIsAFoldOfTheMesh() {
    // A sickle: its midrib is an arc, and every sample of it must be a vertex on the fold.
    QImage image(200, 400, QImage::Format_RGBA8888);
    image.fill(Qt::transparent);
    std::vector<QPointF> midrib;
    const auto rib = [](double t) { return 0.35 + 0.3 * std::sin(3.0 * t); };
    for (int y = 0; y < 400; ++y) {
      const double t = 1 - y / 400.0, half = 60 * std::sin(3.1 * t);
      for (int x = 0; x < 200; ++x) {
        if (std::abs(x - 200 * rib(t)) < half) image.setPixelColor(x, y, Qt::green);
      }
    }
    for (int i = 0; i <= 20; ++i) midrib.emplace_back(rib(i / 20.0), 1 - i / 20.0);
    const Result<LeafMeshes> meshes = fitLeafMeshes({image, midrib.front(), midrib});
    QVERIFY(meshes);
    int onFold = 0;
    for (const LeafVertex& v : (*meshes)[0].vertices) onFold += std::abs(v.rib) < 1e-5f;
    QVERIFY2(onFold >= 10, qPrintable(QString::number(onFold)));
    // No triangle reaches over the fold where the midrib runs inside.
    const LeafMesh& mesh = (*meshes)[0];
    int across = 0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
      float low = 1, high = -1;
      for (size_t k = 0; k < 3; ++k) {
        const LeafVertex& v = mesh.vertices[mesh.indices[i + k]];
        if (v.place.y < 0.1f || v.place.y > 0.9f) low = high = 0;
        low = std::min(low, v.rib);
        high = std::max(high, v.rib);
      }
      across += low < -0.03f && high > 0.03f;
    }
    QCOMPARE(across, 0);
  }

  void nothingOpaqueIsAnErrorInOneLine() {
    QImage empty(64, 64, QImage::Format_RGBA8888);
    empty.fill(Qt::transparent);
    const Result<LeafMeshes> meshes = fitLeafMeshes({empty, {0.5, 1}, {}});
    QVERIFY(!meshes);
    QCOMPARE(QString::fromStdString(meshes.error().message), "the texture shows no leaf: nothing in it is opaque");
    QVERIFY(!fitLeafMeshes({}));
  }
};

WINDFALL_SUITE(LeafMeshTest)
#include "leaf_mesh.moc"
