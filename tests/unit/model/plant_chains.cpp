// Chains, curves, frames and rings of skeletons (plant_meshing.md, 11).
#include <QtTest>
#include <algorithm>
#include <numeric>

#include "model/plant/rings.h"
#include "model/plant/transport.h"
#include "support/skeleton_data.h"
#include "support/suite.h"

using namespace windfall;
using model::Chains;
using model::SkeletonGraph;

namespace {

/// The chains as the ends of their segments, in an order that the file has no part in.
std::vector<std::vector<std::array<float, 3>>> shape(const SkeletonGraph& graph, const Chains& chains) {
  std::vector<std::vector<std::array<float, 3>>> result;
  for (const model::Chain& chain : chains.chains) {
    std::vector<std::array<float, 3>> ends;
    for (std::uint32_t i = 0; i < chain.count; ++i) {
      const vec3 b = graph.segments[chains.links[chain.first + i]].b;
      ends.push_back({b.x, b.y, b.z});
    }
    result.push_back(std::move(ends));
  }
  std::sort(result.begin(), result.end());
  return result;
}

SkeletonGraph shuffled(const SkeletonGraph& graph, std::uint64_t seed) {
  std::vector<std::uint32_t> order(graph.segments.size());
  std::iota(order.begin(), order.end(), 0u);
  RandomSequence random(seed);
  for (std::size_t i = order.size(); i-- > 1;) {
    std::swap(order[i], order[random.below(static_cast<std::uint32_t>(i) + 1)]);
  }
  std::vector<std::int32_t> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<std::int32_t>(i);
  SkeletonGraph result;
  for (const std::uint32_t from : order) {
    result.segments.push_back(graph.segments[from]);
    auto& parent = result.segments.back().parent;
    if (parent >= 0) parent = place[static_cast<std::size_t>(parent)];
  }
  return *sortedGraph(std::move(result));
}

/// Largest angle between the exact normal of a helix after one turn and the carried one, in radians.
template <class Carry>
double helixError(int steps, Carry carry) {
  using V = glm::dvec3;
  constexpr double kRadius = 1, kRise = 0.35, kTurn = 2 * 3.14159265358979323846;
  const auto point = [&](double a) { return V(kRadius * std::cos(a), kRise * a, kRadius * std::sin(a)); };
  const auto tangent = [&](double a) {
    return glm::normalize(V(-kRadius * std::sin(a), kRise, kRadius * std::cos(a)));
  };
  V n(-1, 0, 0);  // Frenet's normal at 0
  for (int i = 0; i < steps; ++i) {
    const double a = kTurn * i / steps, b = kTurn * (i + 1) / steps;
    n = carry(point(a), tangent(a), n, point(b), tangent(b));
  }
  const double speed = std::hypot(kRadius, kRise), torsion = kRise / (speed * speed), length = speed * kTurn;
  const V normal(-1, 0, 0), binormal = glm::cross(tangent(0), normal);
  // Seen from Frenet's frame a frame without twist turns by the torsion, one way or the other.
  double best = 10;
  for (const double sign : {-1.0, 1.0}) {
    const double turn = sign * torsion * length;
    const V exact = normal * std::cos(turn) + binormal * std::sin(turn);
    best = std::min(best, std::acos(std::clamp(glm::dot(exact, n), -1.0, 1.0)));
  }
  return best;
}

}  // namespace

class PlantChainsTest : public QObject {
  Q_OBJECT
 private slots:
  void countsAreTheNotes();
  void siblingsMayStandInAnyOrder();
  void aNamedBranchGoesOn();
  void stubsGiveTheirChildrenAway();
  void loopsAndBadNumbersAreRefused();
  void normalsKeepToTheHelix();
  void straightAndFlatCurvesDoNotTwist();
  void curvesNeverRunBackwardsNorRadiiOver();
  void ringsCarryFramesWithoutTwist();
  void seatsStayInsideTheirParents();
  void splinesStayNearTheirJoints();
  void crowdsAtOneNodeTakeNoTime();
};

void PlantChainsTest::countsAreTheNotes() {
  const SkeletonGraph bush = test::primFile("default_502_v4.prim");
  if (bush.segments.empty()) QSKIP("default_502_v4.prim is not there");
  QCOMPARE(std::count_if(bush.segments.begin(), bush.segments.end(),
                         [](const model::Segment& s) { return s.kind == model::SegmentKind::Petiole; }),
           184);
  for (const auto& [name, graph] : test::realPlants()) {
    const std::map<QString, std::pair<int, int>> expected{{"default_502_v4.prim", {294, 180}},
                                                          {"herb_101_v4.prim", {64, 26}},
                                                          {"japanese_maple", {2179, 526}},
                                                          {"white_birch", {1152, 266}},
                                                          {"quaking_aspen", {158, 30}}};
    QCOMPARE(static_cast<int>(graph.segments.size()), expected.at(name).first);
    for (const model::ChainRule rule : {model::ChainRule::Score, model::ChainRule::Longest}) {
      const Chains chains = findChains(graph, {rule});
      QCOMPARE(static_cast<int>(chains.chains.size()), expected.at(name).second);
      QCOMPARE(chains.links.size(), graph.segments.size());
    }
  }
  const SkeletonGraph maple = test::boneTable("japanese_maple");
  const auto highest = [&](model::ChainRule rule) {
    int most = 0;
    for (const model::Chain& chain : findChains(maple, {rule}).chains) most = std::max(most, chain.order);
    return most;
  };
  QCOMPARE(highest(model::ChainRule::Longest), 10);
  QCOMPARE(highest(model::ChainRule::Score), 8);
}

void PlantChainsTest::siblingsMayStandInAnyOrder() {
  auto plants = test::realPlants();
  plants.emplace_back("made", test::smallTree());
  for (const auto& [name, graph] : plants) {
    for (const model::ChainRule rule : {model::ChainRule::Score, model::ChainRule::Longest}) {
      const auto expected = shape(graph, findChains(graph, {rule}));
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const SkeletonGraph other = shuffled(graph, seed);
        QVERIFY2(shape(other, findChains(other, {rule})) == expected, qPrintable(name));
      }
    }
  }
}

void PlantChainsTest::aNamedBranchGoesOn() {
  SkeletonGraph graph;
  graph.segments = {test::segment({0, 0, 0}, {0, 1, 0}, 0.1f, -1), test::segment({0, 1, 0}, {0, 3, 0}, 0.09f, 0),
                    test::segment({0, 1, 0}, {1, 1, 0}, 0.02f, 0)};
  QCOMPARE(findChains(graph).ofSegment[1], 0);
  graph.segments[0].branch = graph.segments[2].branch = 7;
  const Chains chains = findChains(graph);
  QCOMPARE(chains.ofSegment[2], 0);
  QCOMPARE(chains.ofSegment[1], 1);
  QCOMPARE(chains.chains[1].order, 2);
}

void PlantChainsTest::stubsGiveTheirChildrenAway() {
  SkeletonGraph graph;
  graph.segments = {test::segment({0, 0, 0}, {0, 1, 0}, 0.01f, -1), test::segment({0, 1, 0}, {0, 1.0004f, 0}, 0.01f, 0),
                    test::segment({0, 1.0004f, 0}, {0, 1.0008f, 0}, 0.01f, 1),
                    test::segment({0, 1.0008f, 0}, {0, 1.0012f, 0}, 0.01f, 2),
                    test::segment({0, 1.0012f, 0}, {0, 2, 0}, 0.01f, 3)};
  finishGraph(graph);
  std::vector<std::int32_t> kept;
  const SkeletonGraph rest = withoutStubs(graph, &kept);
  // 0.4 mm and 0.8 mm are below a tenth of the radius, 1.2 mm together are not.
  QCOMPARE(rest.segments.size(), std::size_t{3});
  QCOMPARE(rest.segments[1].parent, 0);
  QCOMPARE(rest.segments[1].a, rest.segments[0].b);
  QCOMPARE(kept, (std::vector<std::int32_t>{0, 0, 0, 1, 2}));
}

void PlantChainsTest::loopsAndBadNumbersAreRefused() {
  const SkeletonGraph good = test::smallTree();
  QVERIFY(sortedGraph(good));
  const auto refused = [&](auto change) {
    SkeletonGraph graph = good;
    change(graph);
    return !sortedGraph(std::move(graph));
  };
  QVERIFY(refused([](SkeletonGraph& g) { g.segments[0].parent = 5; }));
  QVERIFY(refused([](SkeletonGraph& g) { g.segments[3].parent = 3; }));
  QVERIFY(refused([](SkeletonGraph& g) { g.segments[3].parent = 9999; }));
  QVERIFY(refused([](SkeletonGraph& g) { g.segments[3].b.x = std::nanf(""); }));
  QVERIFY(refused([](SkeletonGraph& g) { g.segments[3].ra = -1; }));
  QVERIFY(refused([](SkeletonGraph& g) { g.leaves[0].segment = 9999; }));
  QVERIFY(refused([](SkeletonGraph& g) { g.buds[0].radius = INFINITY; }));
}

void PlantChainsTest::normalsKeepToTheHelix() {
  using V = glm::dvec3;
  const auto rotation = [](V, V t0, V n, V, V t1) { return model::rotatedAlong(t0, t1, n); };
  const auto reflection = [](V x0, V t0, V n, V x1, V t1) { return model::carriedAlong(x0, t0, n, x1, t1); };
  const double hansonMa[] = {1.0e-1, 2.4e-2, 6.0e-3, 1.5e-3}, doubled[] = {1.1e-4, 6.7e-6, 4.2e-7};
  double before = 0;
  for (int i = 0; i < 4; ++i) {
    const double error = helixError(8 << i, rotation);
    QVERIFY2(std::abs(error / hansonMa[i] - 1) < 0.06, qPrintable(QString::number(error)));
    if (i > 0) QVERIFY(std::abs(std::log2(before / error) - 2) < 0.15);
    before = error;
  }
  for (int i = 0; i < 3; ++i) {
    const double error = helixError(8 << i, reflection);
    QVERIFY2(std::abs(error / doubled[i] - 1) < 0.06, qPrintable(QString::number(error)));
    if (i > 0) QVERIFY(std::abs(std::log2(before / error) - 4) < 0.2);
    before = error;
  }
}

void PlantChainsTest::straightAndFlatCurvesDoNotTwist() {
  using V = glm::dvec3;
  V n(0, 0, 1);
  for (int i = 0; i < 50; ++i) {
    const double a = 0.1 * i, b = a + 0.1;
    const auto t = [](double x) { return glm::normalize(V(1, std::cos(x), 0)); };
    n = model::carriedAlong(V(a, std::sin(a), 0), t(a), n, V(b, std::sin(b), 0), t(b));
    QVERIFY(glm::length(n - V(0, 0, 1)) < 1e-12);
  }
  const V up(0, 1, 0), side(1, 0, 0);
  QCOMPARE(model::carriedAlong(V(0), up, side, V(0, 1, 0), up), side);
  QCOMPARE(model::carriedAlong(V(0), up, side, V(0), up), side);
  const V turned = model::carriedAlong(V(0), up, side, V(0, 1, 0), -up);
  QVERIFY(std::abs(glm::length(turned) - 1) < 1e-9);
}

void PlantChainsTest::curvesNeverRunBackwardsNorRadiiOver() {
  auto plants = test::realPlants();
  plants.emplace_back("made", test::smallTree());
  for (const auto& [name, graph] : plants) {
    const Chains chains = findChains(graph);
    for (const model::ChainCurve& curve : makeCurves(graph, chains, model::CurveKind::Hermite)) {
      for (const model::CurveSpan& span : curve.spans) {
        const vec3 chord = span.p1 - span.p0;
        for (int k = 0; k <= 16; ++k) {
          const float t = static_cast<float>(k) / 16, r = span.radius(t);
          QVERIFY2(glm::dot(span.derivative(t), chord) >= -1e-9f, qPrintable(name));
          QVERIFY(r >= std::min(span.r0, span.r1) && r <= std::max(span.r0, span.r1));
        }
      }
      for (std::size_t i = 1; i < curve.spans.size(); ++i) {
        QCOMPARE(curve.spans[i].p0, curve.spans[i - 1].p1);
        QVERIFY(glm::length(curve.spans[i].tangent(0) - curve.spans[i - 1].tangent(1)) < 1e-4f);
      }
    }
  }
}

void PlantChainsTest::ringsCarryFramesWithoutTwist() {
  auto plants = test::realPlants();
  plants.emplace_back("made", test::smallTree());
  for (const auto& [name, graph] : plants) {
    const Chains chains = findChains(graph);
    const auto curves = makeCurves(graph, chains, model::CurveKind::Hermite);
    const model::RingSet set = makeRings(graph, chains, curves, {.collars = false, .flare = 0});
    for (const model::RingChain& chain : set.chains) {
      for (std::uint32_t i = 0; i < chain.count; ++i) {
        const model::Ring& ring = set.rings[chain.first + i];
        QVERIFY(std::abs(glm::length(ring.normal) - 1) < 1e-5f);
        QVERIFY(std::abs(glm::dot(ring.normal, ring.tangent)) < 1e-5f);
        if (i == 0) continue;
        const model::Ring& before = set.rings[chain.first + i - 1];
        using V = glm::dvec3;
        const V n = model::carriedAlong(V(before.position), V(before.tangent), V(before.normal), V(ring.position),
                                        V(ring.tangent));
        const V own(ring.normal), t(ring.tangent);
        const double twist = std::atan2(glm::dot(glm::cross(n, own), t), glm::dot(n, own));
        QVERIFY2(std::abs(twist) < 1e-4, qPrintable(QStringLiteral("%1: %2").arg(name).arg(twist)));
      }
    }
  }
}

void PlantChainsTest::seatsStayInsideTheirParents() {
  // A parent of three sides has an apothem of half its widened radius; the first ring turns about the pivot.
  int seats = 0, exposed = 0;
  auto plants = test::realPlants();
  plants.emplace_back("made", test::smallTree());
  for (const auto& [name, graph] : plants) {
    const Chains chains = findChains(graph);
    const auto curves = makeCurves(graph, chains, model::CurveKind::Hermite);
    const model::RingSet set = makeRings(graph, chains, curves);
    for (std::size_t c = 0; c < chains.chains.size(); ++c) {
      if (chains.chains[c].parent < 0) continue;
      ++seats;
      const model::Ring& base = set.rings[set.chains[c].first];
      QCOMPARE(base.segment, chains.chains[c].parentSegment);
      QVERIFY(glm::length(base.position - curves[c].pivot.point) == 0);
      // The thinnest ring of the parent beside the pivot.
      const model::RingChain& parent = set.chains[static_cast<std::size_t>(chains.chains[c].parent)];
      float thinnest = 1e9f;
      for (std::uint32_t i = 0; i + 1 < parent.count; ++i) {
        const model::Ring &a = set.rings[parent.first + i], &b = set.rings[parent.first + i + 1];
        const auto before = [&](const model::Ring& r) {
          return r.span < curves[c].pivot.span || (r.span == curves[c].pivot.span && r.t <= curves[c].pivot.t);
        };
        if (before(a) && (!before(b) || i + 2 == parent.count)) thinnest = std::min(a.radius, b.radius);
      }
      const float apothem = 0.5f * 1.209f * thinnest;
      exposed += base.radius > apothem;
    }
  }
  QVERIFY(seats > 10);
  QCOMPARE(exposed, 0);
}

void PlantChainsTest::splinesStayNearTheirJoints() {
  const SkeletonGraph graph = test::smallTree();
  const Chains chains = findChains(graph);
  const auto curves = makeCurves(graph, chains, model::CurveKind::BSpline);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const std::vector<model::CurveSpan>& spans = curves[c].spans;
    QVERIFY(glm::length(spans.front().p0 - curves[c].pivot.point) < 1e-6f);
    const auto last = chains.links[chains.chains[c].first + chains.chains[c].count - 1];
    QVERIFY(glm::length(spans.back().p1 - graph.segments[last].b) < 1e-5f);
    for (std::size_t i = 1; i < spans.size(); ++i) {
      QVERIFY(glm::length(spans[i].m0 - spans[i - 1].m1) < 1e-6f);
      // The second derivative goes on as well.
      const auto bend = [](const model::CurveSpan& s, float t) {
        return (s.p0 - s.p1) * (12 * t - 6) + s.m0 * (6 * t - 4) + s.m1 * (6 * t - 2);
      };
      QVERIFY(spans.size() < 3 || glm::length(bend(spans[i], 0) - bend(spans[i - 1], 1)) < 1e-4f);
    }
  }
}

void PlantChainsTest::crowdsAtOneNodeTakeNoTime() {
  SkeletonGraph graph;
  graph.segments.push_back(test::segment({0, 0, 0}, {0, 1, 0}, 0.1f, -1));
  for (int i = 0; i < 100'000; ++i) {
    const float f = static_cast<float>(i);
    graph.segments.push_back(test::segment({0, 1, 0}, {std::sin(f), 1.5f, std::cos(f)}, 0.001f, 0));
  }
  finishGraph(graph);
  const Chains chains = findChains(graph);
  QCOMPARE(chains.chains.size(), std::size_t{100'000});
  const model::RingSet set = makeRings(graph, chains, makeCurves(graph, chains, model::CurveKind::Hermite));
  QVERIFY(set.rings.size() > 200'000);
}

WINDFALL_SUITE(PlantChainsTest)
#include "plant_chains.moc"
