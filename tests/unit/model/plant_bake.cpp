// Loopable clips from the simulation.
#include "model/plant/bake.h"

#include <QTest>
#include <numbers>

#include "model/plant/grower.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

struct Sapling {
  PlantGeometry geometry;
  PlantBodies bodies;
  Sapling() {
    Progress progress;
    geometry = std::move(*grow({.height = 3, .baseRadius = 0.04, .limbs = 4, .levels = 2}, progress));
    bodies = buildBodies(geometry, {});
  }
};

BakeSettings breeze(double tolerance = 0.1) {
  BakeSettings settings;
  settings.name = "Breeze";
  settings.length = 2;
  settings.rate = 24;
  settings.warmUp = 2;
  settings.tolerance = tolerance;
  settings.wind.speed = 9;
  return settings;
}

double angle(const quat& a, const quat& b) {
  return 2 * std::acos(std::min(1.0, std::abs(double(glm::dot(a, b))))) * 180 / std::numbers::pi;
}

}  // namespace

class PlantBakeTest : public QObject {
  Q_OBJECT
 private slots:
  void aLoopEndsAsItBeganAndNeverJumps() {
    const Sapling sapling;
    Progress progress;
    const auto clip = bakeClip(sapling.geometry, sapling.bodies, breeze(0), progress);
    QVERIFY2(clip, clip ? "" : clip.error().message.c_str());
    QVERIFY(clip->looping);
    QCOMPARE(clip->tracks.size(), sapling.bodies.tree.links.size());
    double largest = 0, moved = 0, seam = 0;
    for (const ClipTrack& track : clip->tracks) {
      QCOMPARE(track.times.front(), 0.f);
      QCOMPARE(track.times.back(), 2.f);
      QVERIFY(track.rotations.front() == track.rotations.back());
      for (std::size_t i = 1; i < track.rotations.size(); ++i) {
        largest = std::max(largest, angle(track.rotations[i - 1], track.rotations[i]));
        moved = std::max(moved, angle(track.rotations[0], track.rotations[i]));
      }
      const std::size_t n = track.rotations.size();
      if (n > 3) seam = std::max(seam, angle(track.rotations[n - 2], track.rotations[n - 1]));
    }
    QVERIFY2(moved > 0.3, qPrintable(QString::number(moved)));
    // No step is much larger than those of the same wind without a seam.
    BakeSettings open = breeze(0);
    open.looping = false;
    const auto plain = bakeClip(sapling.geometry, sapling.bodies, open, progress);
    QVERIFY(plain);
    double natural = 0;
    for (const ClipTrack& track : plain->tracks) {
      for (std::size_t i = 1; i < track.rotations.size(); ++i)
        natural = std::max(natural, angle(track.rotations[i - 1], track.rotations[i]));
    }
    QVERIFY2(seam <= natural, qPrintable(QStringLiteral("%1 and %2").arg(seam).arg(natural)));
    QVERIFY2(largest < 1.5 * natural, qPrintable(QStringLiteral("%1 and %2").arg(largest).arg(natural)));
  }

  void keysAreReducedWithinTheTolerance() {
    const Sapling sapling;
    Progress progress;
    const auto full = bakeClip(sapling.geometry, sapling.bodies, breeze(0), progress);
    const auto reduced = bakeClip(sapling.geometry, sapling.bodies, breeze(0.2), progress);
    QVERIFY(full && reduced);
    QVERIFY2(reduced->keyCount() * 2 < full->keyCount(),
             qPrintable(QString("%1 of %2").arg(reduced->keyCount()).arg(full->keyCount())));
    for (std::size_t t = 0; t < full->tracks.size(); ++t) {
      for (std::size_t i = 0; i < full->tracks[t].times.size(); ++i) {
        const quat kept = poseAt(reduced->tracks[t], full->tracks[t].times[i]).rotation;
        QVERIFY(angle(kept, full->tracks[t].rotations[i]) < 0.23);
      }
    }
  }

  void theSameSettingsGiveTheSameClip() {
    const Sapling sapling;
    Progress progress;
    QVERIFY(*bakeClip(sapling.geometry, sapling.bodies, breeze(), progress) ==
            *bakeClip(sapling.geometry, sapling.bodies, breeze(), progress));
  }

  void cancellingAndNonsenseGiveNoClip() {
    const Sapling sapling;
    Progress progress;
    BakeSettings settings = breeze();
    settings.length = -3;
    QVERIFY(!bakeClip(sapling.geometry, sapling.bodies, settings, progress));
    settings = breeze();
    settings.rate = 1e9;
    QVERIFY(!bakeClip(sapling.geometry, sapling.bodies, settings, progress));
    progress.cancel();
    const auto cancelled = bakeClip(sapling.geometry, sapling.bodies, breeze(), progress);
    QVERIFY(!cancelled && cancelled.error().cancelled);
  }
};

WINDFALL_SUITE(PlantBakeTest)
#include "plant_bake.moc"
