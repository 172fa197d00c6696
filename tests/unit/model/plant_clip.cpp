// Recorded motions: interpolation, bytes, and their place in the project file.
#include "model/plant/clip.h"

#include <QTemporaryDir>
#include <QTest>

#include "model/document/project_file.h"
#include "model/plant/geometry.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

quat about(vec3 axis, float degrees) { return glm::angleAxis(glm::radians(degrees), axis); }

Clip nodding() {
  Clip clip;
  clip.name = "Nod";
  clip.length = 2;
  clip.rate = 15;
  clip.looping = true;
  ClipTrack upper{"upper", {0, 1, 2}, {quat(1, 0, 0, 0), about({0, 0, 1}, -40), quat(1, 0, 0, 0)}, {}};
  ClipTrack lower{"lower", {0, 2}, {about({0, 0, 1}, -20), about({0, 0, 1}, -20)}, {vec3(0), vec3(0)}};
  clip.tracks = {upper, lower};
  return clip;
}

std::vector<Bone> twoBones() {
  Bone lower{"lower", -1, {0, 0, 0}, {0, 1, 0}, 0.1f}, upper{"upper", 0, {0, 1, 0}, {0, 2, 0}, 0.1f};
  return {lower, upper};
}

}  // namespace

class PlantClipTest : public QObject {
  Q_OBJECT
 private slots:
  void keysAreInterpolatedOnTheSphere() {
    const Clip clip = nodding();
    const TrackPose half = poseAt(clip.tracks[0], 0.5f);
    QVERIFY(std::abs(glm::dot(half.rotation, about({0, 0, 1}, -20))) > 0.99999f);
    QVERIFY(std::abs(glm::dot(poseAt(clip.tracks[0], -3).rotation, quat(1, 0, 0, 0))) > 0.99999f);
    QVERIFY(std::abs(glm::dot(poseAt(clip.tracks[0], 1).rotation, about({0, 0, 1}, -40))) > 0.99999f);
  }

  void childrenFollowTheirParents() {
    const std::vector<mat4> pose = poseAt(nodding(), twoBones(), 1);
    // The lower bone leans by 20 degrees to +x, the upper by 60 in all.
    const vec3 joint(pose[1] * vec4(0, 1, 0, 1)), tip(pose[1] * vec4(0, 2, 0, 1));
    const auto lean = [](float degrees) {
      return vec3(std::sin(glm::radians(degrees)), std::cos(glm::radians(degrees)), 0);
    };
    QVERIFY(glm::length(joint - lean(20)) < 1e-5f);
    QVERIFY(glm::length(tip - joint - lean(60)) < 1e-5f);
  }

  void aLoopGoesOnAsItBegan() {
    const auto bones = twoBones();
    const auto first = poseAt(nodding(), bones, 0.3), later = poseAt(nodding(), bones, 6.3);
    for (std::size_t i = 0; i < first.size(); ++i) QVERIFY(glm::length(first[i][0] - later[i][0]) < 1e-5f);
  }

  void bytesGoThereAndBack() {
    const Clip clip = nodding();
    std::vector<ClipTrack> read;
    QVERIFY(unpackTracks(packTracks(clip.tracks), read));
    QCOMPARE(read.size(), clip.tracks.size());
    QVERIFY(read == clip.tracks);
  }

  void damagedBytesAreRefused() {
    const QByteArray good = packTracks(nodding().tracks);
    std::vector<ClipTrack> read;
    QVERIFY(!unpackTracks({}, read));
    for (qsizetype length = 1; length < good.size(); length += 7) QVERIFY(!unpackTracks(good.left(length), read));
    QByteArray lying = good;
    lying[8 + 4 + 5] = lying[8 + 4 + 6] = lying[8 + 4 + 7] = '\x7f';  // number of keys
    QVERIFY(!unpackTracks(lying, read));
    QVERIFY(read.empty());
  }

  void theProjectKeepsThem() {
    Project project;
    Plant plant;
    plant.id = {1};
    plant.name = "Nodder";
    plant.grower = GrowerSettings{};
    plant.clips = {nodding()};
    LinkAttributes pinned;
    pinned.pinned = true;
    pinned.rayleighAlpha = 0.25;
    pinned.rayleighBeta = 0.004;
    pinned.propagation = 0.5;
    plant.edits["lower"] = pinned;
    project.plants.push_back(plant);
    project.nextId = 2;
    QTemporaryDir folder;
    const QString path = folder.filePath("clips.windfall"), again = folder.filePath("again.windfall");
    Progress progress;
    QVERIFY(writeProject(project, path, progress));
    const Result<Project> read = readProject(path, progress);
    QVERIFY2(read, read ? "" : read.error().message.c_str());
    QVERIFY(*read == project);
    QVERIFY(writeProject(*read, again, progress));
    QFile a(path), b(again);
    QVERIFY(a.open(QIODevice::ReadOnly) && b.open(QIODevice::ReadOnly));
    QCOMPARE(a.readAll(), b.readAll());
  }
};

WINDFALL_SUITE(PlantClipTest)
#include "plant_clip.moc"
