#include "support/fbx_fixture.h"

#include <QString>
#include <QStringList>

namespace windfall::test {

namespace {

/// Column-major matrix that moves by `height` along the up axis.
QString moved(double height, int upAxis) {
  const double y = upAxis == 1 ? height : 0, z = upAxis == 2 ? height : 0;
  return QStringLiteral("*16 { a: 1,0,0,0,0,1,0,0,0,0,1,0,0,%1,%2,1 }").arg(y).arg(z);
}

QString cluster(int id, const QString& indices, int count, double height, int upAxis) {
  QStringList ones;
  for (int i = 0; i < count; ++i) ones << "1";
  return QStringLiteral(
             "Deformer: %1, \"SubDeformer::c%1\", \"Cluster\" {\n Version: 100\n Indexes: *%2 { a: %3 }\n"
             " Weights: *%2 { a: %4 }\n Transform: %5\n TransformLink: %6\n}\n")
      .arg(id)
      .arg(count)
      .arg(indices, ones.join(','), moved(-height, upAxis), moved(height, upAxis));
}

}  // namespace

QByteArray fbxFixture(double centimetres, int upAxis) {
  // Everything is 1 m in the unit of the file.
  const double metre = 100 / centimetres;
  QStringList places;
  for (int ring = 0; ring < 3; ++ring) {
    for (const auto& [x, s] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      const double across = 0.1 * x * metre, side = 0.1 * s * metre, up = ring * metre;
      places << QString::number(across) << QString::number(upAxis == 1 ? up : side)
             << QString::number(upAxis == 1 ? -side : up);
    }
  }
  QStringList faces;
  for (int ring = 0; ring < 2; ++ring) {
    for (int k = 0; k < 4; ++k) {
      const int a = 4 * ring + k, b = 4 * ring + (k + 1) % 4;
      faces << QString::number(a) << QString::number(b) << QString::number(b + 4) << QString::number(-(a + 4) - 1);
    }
  }
  const auto axis = [](const char* name, int value) {
    return QStringLiteral("  P: \"%1\", \"int\", \"Integer\", \"\",%2\n").arg(QLatin1String(name)).arg(value);
  };
  const auto model = [&](int id, const char* name, const char* kind, double height) {
    return QStringLiteral(
               "Model: %1, \"Model::%2\", \"%3\" {\n Version: 232\n Properties70: {\n"
               "  P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",0,%4,%5\n }\n}\n")
        .arg(id)
        .arg(QLatin1String(name), QLatin1String(kind))
        .arg(upAxis == 1 ? height : 0)
        .arg(upAxis == 2 ? height : 0);
  };
  QString text = QStringLiteral(
      "; FBX 7.4.0 project file\nFBXHeaderExtension: {\n FBXHeaderVersion: 1003\n FBXVersion: 7400\n}\n");
  text += "GlobalSettings: {\n Version: 1000\n Properties70: {\n" + axis("UpAxis", upAxis) + axis("UpAxisSign", 1) +
          axis("FrontAxis", upAxis == 1 ? 2 : 1) + axis("FrontAxisSign", upAxis == 1 ? 1 : -1) + axis("CoordAxis", 0) +
          axis("CoordAxisSign", 1) +
          QStringLiteral("  P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",%1\n }\n}\n").arg(centimetres);
  text += "Definitions: {\n Version: 100\n Count: 0\n}\nObjects: {\n";
  text += QStringLiteral("Geometry: 10, \"Geometry::g\", \"Mesh\" {\n Vertices: *%1 { a: %2 }\n")
              .arg(places.size())
              .arg(places.join(','));
  text += QStringLiteral(" PolygonVertexIndex: *%1 { a: %2 }\n GeometryVersion: 124\n}\n")
              .arg(faces.size())
              .arg(faces.join(','));
  text += model(20, "body", "Mesh", 0) + model(30, "lower", "LimbNode", 0) + model(31, "upper", "LimbNode", metre);
  text += "Deformer: 40, \"Deformer::skin\", \"Skin\" {\n Version: 101\n}\n";
  text += cluster(41, "0,1,2,3,4,5,6,7", 8, 0, upAxis) + cluster(42, "4,5,6,7,8,9,10,11", 8, metre, upAxis);
  text += "}\nConnections: {\n";
  const int links[][2] = {{20, 0}, {30, 0}, {31, 30}, {10, 20}, {40, 10}, {41, 40}, {42, 40}, {30, 41}, {31, 42}};
  for (const auto& link : links) text += QStringLiteral(" C: \"OO\",%1,%2\n").arg(link[0]).arg(link[1]);
  return (text + "}\n").toUtf8();
}

}  // namespace windfall::test
