// The adaptive mesh of real and made skeletons: every chain is drawn whole, once, at any tolerance.
#include <omp.h>

#include <QtTest>
#include <cstring>

#include "kernels/detail_select.h"
#include "model/plant/detail_mesh.h"
#include "model/plant/sample_skeleton.h"
#include "support/skeleton_data.h"

using namespace windfall;

class PlantDetail : public QObject {
  Q_OBJECT

  static DetailMesh meshOf(const model::SkeletonGraph& graph) {
    const model::Chains chains = findChains(graph);
    const auto curves = makeCurves(graph, chains, model::CurveKind::Hermite);
    return model::makeDetail(graph, chains, curves, makeRings(graph, chains, curves));
  }
  static std::vector<std::pair<QString, model::SkeletonGraph>> plants() {
    auto all = test::realPlants();
    all.emplace_back("sample", model::sampleSkeleton(3));
    all.emplace_back("small tree", test::smallTree());
    return all;
  }

 private slots:
  void everyChainIsCoveredOnceOrLeftOut();
  void coarserTolerancesDrawFewerRuns();
  void boundsHoldTheirRings();
  void scalingScalesTolerances();
  void fiftyThousandSegmentsFitIntoTwentyMegabytes();
  void threadsDoNotMatter();
  void runsKeepTheSpeedOfTheirCurve();
  void sampleSkeletonsAreSound();
};

void PlantDetail::everyChainIsCoveredOnceOrLeftOut() {
  for (const auto& [name, graph] : plants()) {
    const DetailMesh mesh = meshOf(graph);
    QVERIFY(!mesh.chains.empty());
    RandomSequence random(7);
    for (int k = 0; k < 200; ++k) {
      const float e = 1e-5f * std::pow(10.0f, static_cast<float>(random.uniform(0, 5)));
      for (const DetailChain& chain : mesh.chains) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> active;
        std::uint32_t first = ~0u, last = 0;
        for (std::uint32_t i = chain.firstEntry; i < chain.firstEntry + chain.entryCount; ++i) {
          const DetailEntry& entry = mesh.entries[i];
          if (entry.from == 0) first = std::min(first, entry.ringA), last = std::max(last, entry.ringB);
          if (entry.from <= e && e < entry.to) active.emplace_back(entry.ringA, entry.ringB);
        }
        std::sort(active.begin(), active.end());
        if (active.empty()) continue;
        QVERIFY2(active.front().first == first, qPrintable(name));
        for (std::size_t i = 1; i < active.size(); ++i) QCOMPARE(active[i].first, active[i - 1].second);
        // Tips of less than a pixel are left out: the two rings of a dome.
        QVERIFY2(active.back().second + 2 >= last, qPrintable(name));
      }
    }
  }
}

void PlantDetail::coarserTolerancesDrawFewerRuns() {
  for (const auto& [name, graph] : plants()) {
    const DetailMesh mesh = meshOf(graph);
    std::size_t before = ~std::size_t{0};
    for (std::uint32_t k = 0; k < kDetailLevels; ++k) {
      const float e = detailTolerance(k);
      const auto drawn = static_cast<std::size_t>(std::count_if(
          mesh.entries.begin(), mesh.entries.end(), [&](const DetailEntry& x) { return x.from <= e && e < x.to; }));
      QVERIFY2(drawn <= before, qPrintable(name));
      before = drawn;
      QVERIFY(mesh.widening[k] >= 0 && mesh.widening[k] <= 1.5f);
    }
    QVERIFY(mesh.entries.size() < 4 * mesh.rings.size());
  }
}

void PlantDetail::boundsHoldTheirRings() {
  for (const auto& [name, graph] : plants()) {
    const DetailMesh mesh = meshOf(graph);
    for (const DetailChain& chain : mesh.chains) {
      for (std::uint32_t i = chain.firstEntry; i < chain.firstEntry + chain.entryCount; ++i) {
        for (const std::uint32_t ring : {mesh.entries[i].ringA, mesh.entries[i].ringB}) {
          const float off = glm::length(mesh.rings[ring].position - mesh.rings[chain.middle].position);
          QVERIFY2(off <= chain.radius * 1.001f + 1e-5f, qPrintable(name));
        }
      }
    }
  }
}

void PlantDetail::scalingScalesTolerances() {
  const DetailMesh one = meshOf(model::sampleSkeleton(2)), two = model::scaled(one, 2);
  QCOMPARE(two.rings[5].radius, 2 * one.rings[5].radius);
  QCOMPARE(two.entries[4].from, 2 * one.entries[4].from);
  QCOMPARE(two.chains[1].radius, 2 * one.chains[1].radius);
  QCOMPARE(detail::widening(two.widening, 2 * detailTolerance(6), 0.02f),
           detail::widening(one.widening, detailTolerance(6), 0.01f));
}

void PlantDetail::fiftyThousandSegmentsFitIntoTwentyMegabytes() {
  const model::SkeletonGraph maple = test::boneTable("japanese_maple");
  if (maple.segments.empty()) QSKIP("the bone table of the maple is not there");
  const DetailMesh mesh = meshOf(maple);
  const std::size_t bytes = mesh.rings.size() * sizeof(DetailRing) + mesh.entries.size() * sizeof(DetailEntry) +
                            mesh.chains.size() * sizeof(DetailChain);
  const double trees = 50'000.0 / static_cast<double>(maple.segments.size());
  QVERIFY2(static_cast<double>(bytes) * trees < 20e6, qPrintable(QString::number(static_cast<double>(bytes) * trees)));
}

void PlantDetail::threadsDoNotMatter() {
  model::SkeletonGraph graph = test::boneTable("japanese_maple");
  if (graph.segments.empty()) graph = test::smallTree(80);
  const int before = omp_get_max_threads();
  std::vector<DetailMesh> meshes;
  for (const int threads : {1, 2, 8}) {
    omp_set_num_threads(threads);
    meshes.push_back(meshOf(graph));
  }
  omp_set_num_threads(before);
  const auto same = [](const auto& a, const auto& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
  };
  for (const DetailMesh& mesh : meshes) {
    QVERIFY(same(mesh.rings, meshes[0].rings));
    QVERIFY(same(mesh.entries, meshes[0].entries));
    QVERIFY(same(mesh.chains, meshes[0].chains));
    QVERIFY(mesh.widening == meshes[0].widening);
  }
}

void PlantDetail::runsKeepTheSpeedOfTheirCurve() {
  // Between two joints the shader's cubic is the curve itself.
  model::SkeletonGraph graph;
  const vec3 joints[] = {{0, 0, 0}, {0.1f, 0.5f, 0}, {0.1f, 0.7f, 0.3f}, {0.5f, 1.2f, 0.2f}};
  for (int i = 0; i < 3; ++i) graph.segments.push_back(test::segment(joints[i], joints[i + 1], 0.01f, i - 1));
  finishGraph(graph);
  const model::Chains chains = findChains(graph);
  const auto curves = makeCurves(graph, chains, model::CurveKind::Hermite);
  model::RingSettings bare;
  bare.collars = false, bare.flare = 0;
  const DetailMesh mesh = model::makeDetail(graph, chains, curves, makeRings(graph, chains, curves, bare));
  int runs = 0;
  for (const DetailEntry& entry : mesh.entries) {
    if (entry.from > 0 || entry.ringB != entry.ringA + 1 || entry.ringB > 3) continue;
    const DetailRing &a = mesh.rings[entry.ringA], &b = mesh.rings[entry.ringB];
    const float chord = glm::distance(a.position, b.position);
    const vec3 m0 = a.tangent * (chord * static_cast<float>((entry.shape >> 2) & 0x7fffu) / 8192),
               m1 = b.tangent * (chord * static_cast<float>(entry.shape >> 17) / 8192);
    for (const float t : {0.2f, 0.5f, 0.9f}) {
      const float s = 1 - t;
      const vec3 p =
          a.position * ((1 + 2 * t) * s * s) + m0 * (t * s * s) + b.position * (t * t * (3 - 2 * t)) - m1 * (t * t * s);
      QVERIFY(glm::distance(p, curves[0].spans[entry.ringA].point(t)) < 1e-4f * chord);
    }
    ++runs;
  }
  QCOMPARE(runs, 3);
}

void PlantDetail::sampleSkeletonsAreSound() {
  const model::SkeletonGraph graph = model::sampleSkeleton(5);
  QVERIFY(graph.segments.size() > 150 && graph.segments.size() < 800);
  QVERIFY(bool(sortedGraph(graph)));
  QCOMPARE(graph, model::sampleSkeleton(5));
  QVERIFY(!(graph == model::sampleSkeleton(6)));
}

WINDFALL_SUITE(PlantDetail)
#include "plant_detail.moc"
