// The adaptive mesh of real and made skeletons: every chain is drawn whole, once, at any tolerance.
#include <QtTest>

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

void PlantDetail::sampleSkeletonsAreSound() {
  const model::SkeletonGraph graph = model::sampleSkeleton(5);
  QVERIFY(graph.segments.size() > 150 && graph.segments.size() < 800);
  QVERIFY(bool(sortedGraph(graph)));
  QCOMPARE(graph, model::sampleSkeleton(5));
  QVERIFY(!(graph == model::sampleSkeleton(6)));
}

WINDFALL_SUITE(PlantDetail)
#include "plant_detail.moc"
