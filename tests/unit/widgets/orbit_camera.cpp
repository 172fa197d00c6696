#include "widgets/viewport/orbit_camera.h"

#include <QtTest>
#include <glm/geometric.hpp>

#include "support/suite.h"

using namespace windfall;
using namespace windfall::widgets;

class OrbitCameraTest : public QObject {
  Q_OBJECT
  static constexpr QSize kSize{800, 600};

 private slots:
  void projectsWhatARayGoesThrough() {
    OrbitCamera camera;
    camera.orbit({130, 40});
    for (const QPointF pixel : {QPointF(400, 300), QPointF(10, 20), QPointF(790, 580)}) {
      const Ray ray = camera.ray(pixel, kSize);
      const auto back = camera.project(ray.origin + ray.direction * 7.f, kSize);
      QVERIFY(back);
      QVERIFY(std::hypot(back->x() - pixel.x(), back->y() - pixel.y()) < 0.05);
    }
  }

  void hidesWhatLiesBehindTheEye() {
    const OrbitCamera camera;
    QVERIFY(!camera.project(camera.eye() * 2.f - camera.target(), kSize));
  }

  void dragToTheRightTurnsTheSceneToTheRight() {
    OrbitCamera camera;
    const vec3 nearSide = camera.target() + glm::normalize(camera.eye() - camera.target());
    const auto before = camera.project(nearSide, kSize);
    camera.orbit({40, 0});
    QVERIFY(camera.project(nearSide, kSize)->x() > before->x() + 5);
  }

  void dragDownLooksFromHigherUp() {
    OrbitCamera camera;
    const float before = camera.eye().y;
    camera.orbit({0, 40});
    QVERIFY(camera.eye().y > before);
  }

  void eyeNeverGoesUnderground() {
    OrbitCamera camera;
    camera.orbit({0, -5000});
    QVERIFY(camera.eye().y > 0.1f);
    camera.pan({0, -20000}, kSize);
    QVERIFY(camera.eye().y > 0.1f);
  }

  void panKeepsTheTargetUnderThePointer() {
    OrbitCamera camera;
    const vec3 place = camera.target();
    camera.pan({37, -12}, kSize);
    const auto now = camera.project(place, kSize);
    QVERIFY(std::abs(now->x() - 437) < 0.1 && std::abs(now->y() - 288) < 0.1);
  }

  void zoomKeepsWhatIsUnderThePointer() {
    OrbitCamera camera;
    const QPointF pointer(610, 170);
    const Ray ray = camera.ray(pointer, kSize);
    const vec3 forward = glm::normalize(camera.target() - camera.eye());
    const vec3 place = ray.origin + ray.direction * (16.f / glm::dot(ray.direction, forward));
    camera.zoom(3, pointer, kSize);
    QVERIFY(camera.state().distance < 10);
    const auto now = camera.project(place, kSize);
    QVERIFY(std::abs(now->x() - pointer.x()) < 0.1 && std::abs(now->y() - pointer.y()) < 0.1);
  }

  void framedBoxIsWhollyInThePicture() {
    const Box box{{-3, 0, -2}, {4, 9, 2}};
    for (const QSize size : {QSize(800, 600), QSize(300, 900)}) {
      OrbitCamera camera;
      camera.frame(box, size);
      double filled = 0;
      for (int corner = 0; corner < 8; ++corner) {
        const vec3 place(corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                         corner & 4 ? box.upper.z : box.lower.z);
        const auto pixel = camera.project(place, size);
        QVERIFY(pixel && QRectF({0, 0}, QSizeF(size)).contains(*pixel));
        filled = std::max(
            {filled, std::abs(2 * pixel->x() / size.width() - 1), std::abs(2 * pixel->y() / size.height() - 1)});
      }
      QVERIFY2(filled > 0.85, qPrintable(QString::number(filled)));
    }
  }

  void topViewLooksDownWithNorthUp() {
    OrbitCamera camera;
    camera.look(StandardView::Top);
    const auto north = camera.project(camera.target() + vec3(0, 0, -2), kSize);
    QVERIFY(north && north->y() < 280 && std::abs(north->x() - 400) < 0.5);
  }

  void betweenTurnsTheShortWay() {
    model::Camera first, second;
    first.azimuth = 170;
    second.azimuth = -170;
    QCOMPARE(between(first, second, 0.5).azimuth, 180.0);
    QCOMPARE(between(first, second, 1).distance, second.distance);
  }
};

WINDFALL_SUITE(OrbitCameraTest)
#include "orbit_camera.moc"
