#include "widgets/viewport/camera_json.h"

#include <QJsonArray>
#include <QtTest>

#include "support/suite.h"

using namespace windfall;
using namespace windfall::widgets;

class CameraJsonTest : public QObject {
  Q_OBJECT
 private slots:
  void comesBackAsItWas() {
    model::Camera camera;
    camera.target = {1.5f, -2.25f, 3};
    camera.azimuth = -121.125;
    camera.distance = 3.5;
    QCOMPARE(cameraFromJson(toJson(camera)), camera);
  }

  void nonsenseIsNoCamera() {
    QVERIFY(!cameraFromJson({}));
    for (const auto& [key, value] :
         std::initializer_list<std::pair<QString, QJsonValue>>{{"distance", 0},
                                                               {"distance", -3},
                                                               {"distance", "far"},
                                                               {"elevation", 90},
                                                               {"fieldOfView", 0},
                                                               {"azimuth", 1e300},
                                                               {"target", QJsonArray{1, 2}},
                                                               {"target", QJsonArray{1, 2, "up"}}}) {
      QJsonObject object = toJson(model::Camera());
      object[key] = value;
      QVERIFY2(!cameraFromJson(object), qPrintable(key));
    }
  }
};

WINDFALL_SUITE(CameraJsonTest)
#include "camera_json.moc"
