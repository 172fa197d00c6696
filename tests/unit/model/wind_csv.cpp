// Recorded wind from tables.
#include "model/scene/wind_csv.h"

#include <QTest>

#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

QString errorOf(const QByteArray& csv) {
  const auto read = readWindCsv(csv);
  return read ? QString() : QString::fromStdString(read.error().message);
}

}  // namespace

class WindCsvTest : public QObject {
  Q_OBJECT
 private slots:
  void plainRows() {
    const auto read = readWindCsv("0, 3.5, 270\n10,4.5,280\r\n\n20,6,350\n");
    QVERIFY(read);
    QCOMPARE(read->size(), std::size_t(3));
    // From the west is to the east.
    QVERIFY((read->at(0) == sim::WindRecord{0, 3.5f, 90}));
    QVERIFY((read->at(1) == sim::WindRecord{10, 4.5f, 100}));
    QVERIFY((read->at(2) == sim::WindRecord{20, 6, 170}));
  }

  void columnsByNameInAnyOrderWithUnits() {
    const auto read = readWindCsv(
        "# a mast\nstation;Wind direction [deg];Speed (km/h);Time\n"
        "X;90;36,0;2024-03-31T01:59:30\nX;180;18,0;2024-03-31T02:00:30\n");
    QVERIFY2(read, read ? "" : read.error().message.c_str());
    QVERIFY(std::abs(read->at(0).speed - 10) < 1e-5f);
    QCOMPARE(read->at(0).heading, 270.f);
    QCOMPARE(read->at(1).time, 60.f);
    QCOMPARE(read->at(1).heading, 0.f);
  }

  void clockTimesAndHeadings() {
    const auto read = readWindCsv("time\tspeed\tblows to\n14:05:00\t2\t45\n14:06:30\t3\t-45\n");
    QVERIFY2(read, read ? "" : read.error().message.c_str());
    QCOMPARE(read->at(1).time, 90.f);
    QCOMPARE(read->at(0).heading, 45.f);
    QCOMPARE(read->at(1).heading, 315.f);
  }

  void speedAloneBlowsEast() {
    const auto read = readWindCsv("0,3\n1,4\n");
    QVERIFY(read);
    QCOMPARE(read->at(1).heading, 90.f);
  }

  void damageIsNamedWithItsLine() {
    QCOMPARE(errorOf("time,speed,direction\n0,3,90\n1,abc,90\n"), "line 3: the speed \"abc\" is not a number");
    QCOMPARE(errorOf("0,3,90\n5,3,90\n4,3,90\n"), "line 3: the time does not go on from the line before");
    QCOMPARE(errorOf("0,3,90\n1,3\n"), "line 2: the direction is missing");
    QCOMPARE(errorOf("0,3,90\n1,-3,90\n"), "line 2: a speed of -3 m/s cannot be");
    QCOMPARE(errorOf("0,3,90\n1,3,900\n"), "line 2: the direction is not from 0 to 360 degrees");
    QCOMPARE(errorOf("0,3,90\n1,nan,90\n"), "line 2: the speed \"nan\" is not a number");
    QCOMPARE(errorOf("apples,pears\n1,2\n"), "its first line names no column \"time\"");
    QCOMPARE(errorOf(""), "has no row of time, speed and direction");
    QCOMPARE(errorOf("time,speed,direction\n"), "has no row of time, speed and direction");
    QCOMPARE(errorOf(QByteArray("\x7f"
                                "ELF\0\0\0",
                                7)),
             "is not a text file");
  }
};

WINDFALL_SUITE(WindCsvTest)
#include "wind_csv.moc"
