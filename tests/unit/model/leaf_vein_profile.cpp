#include <QtTest>
#include <cmath>

#include "model/leaf/vein_profile.h"
#include "support/suite.h"

using namespace windfall::model;

namespace {

constexpr int kSide = 256;

/// A square blade with a vein up its middle, and a strip at its foot that is the petiole.
struct Square {
  LeafStructure structure;
  VeinFrame frame;
  std::vector<float> lab;

  explicit Square(float line, float standing = 0.7f) {
    const size_t pixels = size_t{kSide} * kSide;
    structure.distance.size = structure.veinDistance.size = structure.regions.size = {kSide, kSide};
    structure.distance.values.assign(pixels, 0.5f);
    structure.veinDistance.values.resize(pixels);
    structure.regions.values.assign(pixels, 1);
    structure.regions.count = 2, structure.regions.petiole = 2;
    frame.reach.resize(pixels);
    frame.standing.assign(pixels, standing);
    lab.assign(3 * pixels, 0.f);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const size_t i = static_cast<size_t>(y) * kSide + static_cast<size_t>(x);
        const float d = std::abs(static_cast<float>(x) - kSide / 2.f);
        frame.reach[i] = d;
        structure.veinDistance.values[i] = d;
        if (y >= kSide - 20) structure.regions.values[i] = 2;
        // A slow change of colour that is no vein's, and the vein.
        lab[3 * i] = 40 + 0.05f * static_cast<float>(y) + line * std::exp(-d * d / 4);
        lab[3 * i + 1] = -20, lab[3 * i + 2] = 25;
      }
    }
  }
  float light(int x, int y, const std::vector<float>& of) const {
    return of[3 * (static_cast<size_t>(y) * kSide + static_cast<size_t>(x))];
  }
};

}  // namespace

class LeafVeinProfile : public QObject {
  Q_OBJECT
 private slots:
  void aLostVeinComesBackAsTheExampleHasIt() {
    const Square plain(0), veined(8);
    const std::vector<float> restored =
        restoreVeins({plain.structure, plain.frame, plain.lab}, {veined.structure, veined.frame, veined.lab});
    const float middle = veined.light(kSide / 2, 100, restored) - plain.light(kSide / 2, 100, plain.lab);
    QVERIFY2(middle > 4.5f && middle < 8.5f, qPrintable(QString::number(middle)));
    // Far from the vein nothing changes, nor does the slow change of colour.
    for (const int y : {20, 100, 200}) {
      QCOMPARE(restored[3 * (static_cast<size_t>(y) * kSide + 10)], plain.light(10, y, plain.lab));
    }
  }

  void whatIsAlreadyThereStays() {
    const Square veined(8);
    const std::vector<float> same =
        restoreVeins({veined.structure, veined.frame, veined.lab}, {veined.structure, veined.frame, veined.lab});
    QCOMPARE(same, veined.lab);
  }

  void veinsOfOtherStandingLendNothing() {
    // The example has fine veins alone: they do not tell how a main vein looks.
    const Square plain(0, 0.9f), fine(8, 0.05f);
    QCOMPARE(restoreVeins({plain.structure, plain.frame, plain.lab}, {fine.structure, fine.frame, fine.lab}),
             plain.lab);
  }

  void petiolesKeepTheirColours() {
    const Square plain(0), veined(8);
    const std::vector<float> restored =
        restoreVeins({plain.structure, plain.frame, plain.lab}, {veined.structure, veined.frame, veined.lab});
    for (int x = 0; x < kSide; ++x) QCOMPARE(plain.light(x, kSide - 5, restored), plain.light(x, kSide - 5, plain.lab));
  }
};

WINDFALL_SUITE(LeafVeinProfile)
#include "leaf_vein_profile.moc"
