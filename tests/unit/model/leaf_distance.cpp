#include "model/leaf/distance.h"

#include <QtTest>
#include <queue>

#include "kernels/random.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

int costOf(Tissue from, Tissue to, const DistanceCosts& costs) {
  if (from != Tissue::Vein) return costs.tissueTissue;
  return to == Tissue::Vein ? costs.veinVein : costs.veinTissue;
}

/// Dijkstra with a heap, straight from the definition.
std::vector<std::int32_t> byHeap(const std::vector<Tissue>& types, QSize size, QPoint source,
                                 const DistanceCosts& costs) {
  std::vector<std::int32_t> distance(types.size(), -1);
  using Item = std::pair<std::int32_t, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
  open.emplace(0, source.y() * size.width() + source.x());
  while (!open.empty()) {
    const auto [value, at] = open.top();
    open.pop();
    if (distance[static_cast<size_t>(at)] >= 0) continue;
    distance[static_cast<size_t>(at)] = value;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = at % size.width() + dx, y = at / size.width() + dy;
        if (x < 0 || y < 0 || x >= size.width() || y >= size.height()) continue;
        const int next = y * size.width() + x;
        if (types[static_cast<size_t>(next)] == Tissue::Outside || distance[static_cast<size_t>(next)] >= 0) continue;
        open.emplace(value + (dx != 0 && dy != 0 ? 14 : 10) *
                                 costOf(types[static_cast<size_t>(at)], types[static_cast<size_t>(next)], costs),
                     next);
      }
    }
  }
  return distance;
}

}  // namespace

class LeafDistance : public QObject {
  Q_OBJECT
 private slots:
  void equalsDijkstraOnRandomLeaves() {
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
      const QSize size(31, 23);
      std::vector<Tissue> types;
      for (std::uint32_t i = 0; i < 31 * 23; ++i) {
        const float u = uniform(seed, i);
        types.push_back(u < 0.3f ? Tissue::Outside : u < 0.75f ? Tissue::Blade : Tissue::Vein);
      }
      types[11 * 31 + 15] = Tissue::Vein;
      for (const DistanceCosts& costs : {DistanceCosts{}, DistanceCosts{2, 3, 5}, DistanceCosts{7, 1, 1}}) {
        QCOMPARE(structuralDistance(types, size, {15, 11}, costs), byHeap(types, size, {15, 11}, costs));
      }
    }
  }

  void aCorridorCostsItsSteps() {
    const std::vector<Tissue> types{Tissue::Vein,  Tissue::Vein,  Tissue::Vein,
                                    Tissue::Blade, Tissue::Blade, Tissue::Vein};
    const std::vector<std::int32_t> expected{0, 10, 20, 60, 140, 220};
    QCOMPARE(structuralDistance(types, {6, 1}, {0, 0}, {1, 4, 8}), expected);
  }

  void growsAlongAVeinAndUnreachedPlacesSaySo() {
    std::vector<Tissue> types(40 * 9, Tissue::Blade);
    for (size_t x = 0; x < 40; ++x) types[4 * 40 + x] = Tissue::Vein;
    for (size_t y = 0; y < 9; ++y) types[y * 40 + 35] = Tissue::Outside;
    const auto distance = structuralDistance(types, {40, 9}, {0, 4}, {});
    for (size_t x = 1; x < 35; ++x) QVERIFY(distance[4 * 40 + x] > distance[4 * 40 + x - 1]);
    QCOMPARE(distance[4 * 40 + 38], -1);
    QCOMPARE(distance[4 * 40 + 35], -1);
    const ScalarField field = normalised(distance, {40, 9}, types);
    QCOMPARE(field.values[4 * 40 + 38], 1.0f);
    QCOMPARE(field.values[4 * 40 + 35], 0.0f);
    QCOMPARE(field.values[4 * 40], 0.0f);
  }
};

WINDFALL_SUITE(LeafDistance)
#include "leaf_distance.moc"
