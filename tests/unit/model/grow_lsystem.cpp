// The language of the L-systems: derivation and turtle against the method note's numbers, and what goes wrong.
#include <omp.h>
#include <QElapsedTimer>
#include <QtTest>
#include <cmath>
#include <cstring>

#include "model/plant/grow/draw.h"
#include "model/plant/grow/lsystem.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;
using namespace windfall::model::growth;

namespace {

/// Out of line: GCC 12 sees overruns in inlined short strings that are none.
[[gnu::noinline]] std::string str(const char* text) { return text; }

const char* kBush = "#define angle 25.7\n#define step 0.02\naxiom: X\nX -> F[+X][-X]FX\nF -> FF\n";
const char* kTernary =
    "#define d1 94.74\n#define d2 132.63\n#define a 18.95\n#define lr 1.109\n#define vr 1.732\n#define bend 0.08\n"
    "axiom: !(0.006)F(0.7)/(45)A\n"
    "A -> !(0.006*vr)F(0.35)[&(a)F(0.35)A]/(d1)[&(a)F(0.35)A]/(d2)[&(a)F(0.35)A]\n"
    "F(l) -> F(l*lr)\n!(w) -> !(w*vr)\n";
const char* kMonopodial =
    "#define r1 0.9\n#define r2 0.6\n#define a0 45\n#define a2 45\n#define d 137.5\n#define wr 0.707\n"
    "axiom: A(1.4,0.22)\n"
    "A(l,w) -> !(w)F(l)[&(a0)B(l*r2,w*wr)]/(d)A(l*r1,w*wr)\n"
    "B(l,w) -> !(w)F(l)[-(a2)$C(l*r2,w*wr)]C(l*r1,w*wr)\n"
    "C(l,w) -> !(w)F(l)[+(a2)$B(l*r2,w*wr)]B(l*r1,w*wr)\n";
const char* kSympodial =
    "#define r1 0.9\n#define r2 0.8\n#define a1 20\n#define a2 50\n#define wr 0.707\n"
    "axiom: A(1.4,0.22)\n"
    "A(l,w) -> !(w)F(l)[&(a1)B(l*r1,w*wr)]/(180)[&(a2)B(l*r2,w*wr)]\n"
    "B(l,w) -> !(w)F(l)[+(a1)$B(l*r1,w*wr)][-(a2)$B(l*r2,w*wr)]\n";

LSystem parsed(const char* text) {
  const Parsed result = parseRules(text);
  for (const RuleError& error : result.errors) qWarning("%s", error.text().c_str());
  return result.system;
}

Derived derived(const LSystem& system, int generations, std::uint64_t seed = 1) {
  Progress progress;
  Result<Derived> result = derive(system, generations, seed, {}, progress);
  if (!result) qWarning("%s", result.error().message.c_str());
  return result ? std::move(*result) : Derived{};
}

quint64 namesHash(const LSystem& system, const ModuleString& modules) {
  std::uint64_t h = 0;
  for (const char c : namesOf(system, modules)) h = mix(h ^ static_cast<std::uint64_t>(c));
  return h;
}

std::string firstError(const std::string& text) {
  const Parsed result = parseRules(text);
  return result.errors.empty() ? "" : result.errors.front().text();
}

struct Extent {
  double height = 0, radius = 0;
};
Extent extentOf(const Grown& grown) {
  Extent e;
  for (const dvec3& p : grown.position) {
    e.height = std::max(e.height, p.y);
    e.radius = std::max(e.radius, std::hypot(p.x, p.z));
  }
  return e;
}

}  // namespace

class GrowLSystemTest : public QObject {
  Q_OBJECT
 private slots:
  void workedGrammarsGiveTheNotesCounts_data();
  void workedGrammarsGiveTheNotesCounts();
  void worldSizesAreThoseOfTheNote();
  void contextCarriesASignalUpEveryPath();
  void stochasticRulesFollowTheirWeights();
  void aChoiceDependsOnItsPathAlone();
  void threadsDoNotChangeTheBits();
  void parallelTurtleWalksTheSameWay();
  void messagesNameLineAndColumn_data();
  void messagesNameLineAndColumn();
  void explosionsStopWithTheLastWholeGeneration();
  void endlessRulesEnd();
  void nonsenseWhileDerivingIsAnError();
  void cutsRemoveTheRestOfTheirBranch();
  void hostileTextIsRefused();
};

void GrowLSystemTest::workedGrammarsGiveTheNotesCounts_data() {
  QTest::addColumn<QByteArray>("rules");
  QTest::addColumn<QList<int>>("counts");
  QTest::addColumn<quint64>("hash");
  QTest::addRow("a") << QByteArray(kBush) << QList<int>{1, 11, 43, 143, 451, 1391, 4243, 12863}
                     << Q_UINT64_C(0x45a671ebeba11988);
  QTest::addRow("b") << QByteArray(kTernary) << QList<int>{4, 22, 76, 238, 724, 2182, 6556}
                     << Q_UINT64_C(0xc9ede80f641cd5b3);
  QTest::addRow("c") << QByteArray(kMonopodial) << QList<int>{1, 8, 22, 50, 106, 218, 442, 890, 1786, 3578, 7162}
                     << Q_UINT64_C(0xbfb7aaa24d196fcc);
  QTest::addRow("d") << QByteArray(kSympodial) << QList<int>{1, 11, 33, 77, 165, 341, 693, 1397, 2805, 5621, 11253}
                     << Q_UINT64_C(0xbef2c9f55ef832de);
}

void GrowLSystemTest::workedGrammarsGiveTheNotesCounts() {
  QFETCH(QByteArray, rules);
  QFETCH(QList<int>, counts);
  QFETCH(quint64, hash);
  const LSystem system = parsed(rules.constData());
  const Derived result = derived(system, static_cast<int>(counts.size()) - 1);
  QCOMPARE(static_cast<qsizetype>(result.counts.size()), counts.size());
  for (qsizetype i = 0; i < counts.size(); ++i)
    QCOMPARE(static_cast<int>(result.counts[static_cast<std::size_t>(i)]), counts[i]);
  QCOMPARE(namesHash(system, result.modules), hash);
}

void GrowLSystemTest::worldSizesAreThoseOfTheNote() {
  struct Case {
    const char* rules;
    int generations;
    std::size_t links;
    double height, radius;
  };
  for (const Case& c : {Case{kBush, 7, 4118, 5.080, -1}, Case{kTernary, 6, 1457, 6.662, 3.774},
                        Case{kMonopodial, 10, 1023, 9.119, 3.639}, Case{kSympodial, 10, 1023, 7.376, 5.186}}) {
    const LSystem system = parsed(c.rules);
    const Result<Grown> grown = interpretInOrder(system, derived(system, c.generations).modules, {});
    QVERIFY(grown);
    QCOMPARE(grown->size(), c.links + 1);
    const Extent extent = extentOf(*grown);
    QVERIFY2(std::abs(extent.height - c.height) < 2e-3, qPrintable(QString::number(extent.height)));
    if (c.radius > 0) QVERIFY2(std::abs(extent.radius - c.radius) < 2e-3, qPrintable(QString::number(extent.radius)));
  }
}

void GrowLSystemTest::contextCarriesASignalUpEveryPath() {
  const LSystem system = parsed("#ignore + -\naxiom: Z[+Y]Y-Y[+Y]Y\nZ < Y -> Z\nZ -> Y\n");
  const char* expected[] = {"Z[+Y]Y-Y[+Y]Y", "Y[+Z]Z-Y[+Y]Y", "Y[+Y]Y-Z[+Y]Y", "Y[+Y]Y-Y[+Z]Z", "Y[+Y]Y-Y[+Y]Y"};
  for (int i = 0; i < 5; ++i) QCOMPARE(namesOf(system, derived(system, i).modules), std::string(expected[i]));
  // The other way: right contexts skip whole side branches and end with the branch.
  const LSystem right = parsed("#ignore + -\naxiom: Y[+Y]Y[-Z]YZ\nY > Z -> Z\n");
  QCOMPARE(namesOf(right, derived(right, 3).modules), str("Z[+Y]Z[-Z]ZZ"));
}

void GrowLSystemTest::stochasticRulesFollowTheirWeights() {
  const LSystem system = parsed("#seed 7\naxiom: A\nA ; 0.33 -> F[+A]F[-A]F\nA ; 0.33 -> F[+A]F\nA ; 0.34 -> F[-A]F\n");
  const std::vector<std::size_t> expected = {1, 11, 21, 31, 46, 66, 91, 121, 161};
  QCOMPARE(derived(system, 8, 7).counts, expected);
  std::string axiom = "axiom: ";
  for (int i = 0; i < 10'000; ++i) axiom += "A";
  const LSystem three = parsed((axiom + "\nA ; 0.2 -> B\nA ; 0.5 -> C\nA ; 0.3 -> D\n").c_str());
  const std::string names = namesOf(three, derived(three, 1, 7).modules);
  QCOMPARE(std::count(names.begin(), names.end(), 'B'), 1960);
  QCOMPARE(std::count(names.begin(), names.end(), 'C'), 5008);
  QCOMPARE(std::count(names.begin(), names.end(), 'D'), 3032);
}

void GrowLSystemTest::aChoiceDependsOnItsPathAlone() {
  // The second branch draws the same whatever the first one holds.
  const LSystem small = parsed("axiom: [A]Q\nA ; 1 -> B\nA ; 1 -> C\nQ -> [AAAA]");
  const LSystem large = parsed("axiom: [A]Q\nA ; 1 -> B\nA ; 1 -> C\nQ -> [AAAA]\nB -> DDDD\nC -> DDDD");
  const std::string a = namesOf(small, derived(small, 2, 3).modules), b = namesOf(large, derived(large, 2, 3).modules);
  QCOMPARE(a.substr(a.rfind('[')), b.substr(b.rfind('[')));
}

void GrowLSystemTest::threadsDoNotChangeTheBits() {
  const LSystem system =
      parsed("axiom: A(9)\nA(k) ; 2 -> F(k)[+(k)A(k*0.9)]/(90)A(k+1)\nA(k) ; 1 -> F(k)[-A(k/2)]A(k)A(k-1)\n");
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Derived one = derived(system, 14, 5);
  omp_set_num_threads(4);
  const Derived four = derived(system, 14, 5);
  omp_set_num_threads(before);
  QVERIFY(one.modules.size() > 50'000);
  QCOMPARE(one.modules.symbol, four.modules.symbol);
  QCOMPARE(one.modules.id, four.modules.id);
  QVERIFY(std::memcmp(one.modules.parameter.data(), four.modules.parameter.data(),
                      one.modules.parameter.size() * sizeof(double)) == 0);
}

void GrowLSystemTest::parallelTurtleWalksTheSameWay() {
  const LSystem system =
      parsed("axiom: !(0.3)A(1)\nA(l) -> !(l/9)F(l)[&(40)'A(l*0.8)~(0.04)][/(120)&(35)A(l*0.7)]/(137)A(l*0.9)\n");
  const Derived result = derived(system, 9);
  QVERIFY(result.modules.size() > 5 * 4096);
  LSystemLimits limits;
  const Result<Grown> serial = interpretInOrder(system, result.modules, limits);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Result<Grown> one = interpretInParallel(system, result.modules, limits);
  omp_set_num_threads(3);
  const Result<Grown> three = interpretInParallel(system, result.modules, limits);
  omp_set_num_threads(before);
  QVERIFY(serial && one && three);
  QCOMPARE(one->size(), serial->size());
  QCOMPARE(one->leaves.size(), serial->leaves.size());
  QVERIFY(std::memcmp(one->position.data(), three->position.data(), one->size() * sizeof(dvec3)) == 0);
  for (std::size_t i = 0; i < one->size(); ++i) {
    QCOMPARE(one->parent[i], serial->parent[i]);
    QCOMPARE(one->radius[i], serial->radius[i]);
    QVERIFY(glm::length(one->position[i] - serial->position[i]) < 1e-9);
  }
  for (std::size_t i = 0; i < one->leaves.size(); ++i) {
    QCOMPARE(one->leaves[i].node, serial->leaves[i].node);
    QCOMPARE(one->leaves[i].colour, serial->leaves[i].colour);
  }
}

void GrowLSystemTest::messagesNameLineAndColumn_data() {
  QTest::addColumn<QByteArray>("rules");
  QTest::addColumn<QByteArray>("message");
  const auto row = [](const char* name, const char* rules, const char* message) {
    QTest::addRow("%s", name) << QByteArray(rules) << QByteArray(message);
  };
  row("open bracket", "axiom: A\nA -> F+(30", "2:8: '(' is never closed");
  row("no arrow", "axiom: A\nA F", "2:1: expected '->'");
  row("stray sign", "axiom: A\nA -> F #", "2:8: unexpected '#', expected a module");
  row("no axiom", "A -> F", "1:1: there is no axiom; write \"axiom: F\"");
  row("unknown name", "axiom: A(1)\nA(k) -> F(k*q)", "2:13: unknown name 'q'");
  row("arguments", "axiom: F(min(1))", "1:10: 'min' takes 2 arguments, not 1");
  row("unbalanced", "axiom: A\nA -> F[+A", "2:7: '[' is never closed");
  row("closes nothing", "axiom: A\nA -> F]A", "2:7: ']' closes nothing");
  row("twice", "axiom: A\nA(k,k) -> F", "2:5: the parameter 'k' is named twice");
  row("weight", "axiom: A\nA ; 0 -> F", "2:5: the weight must be above 0");
  row("division", "axiom: F(1/0)", "1:11: division by zero");
  row("directive", "#foo 3\naxiom: F", "1:1: unknown directive '#foo'");
  row("iterations", "#iterations 1e9\naxiom: F", "1:1: iterations must be a whole number, 0 to 1000");
  row("bracket rule", "axiom: F\n[ -> F", "2:1: brackets have no rules");
}

void GrowLSystemTest::messagesNameLineAndColumn() {
  QFETCH(QByteArray, rules);
  QFETCH(QByteArray, message);
  QCOMPARE(QByteArray::fromStdString(firstError(rules.toStdString())), message);
}

void GrowLSystemTest::explosionsStopWithTheLastWholeGeneration() {
  const LSystem system = parsed("axiom: F\nF -> FFFFFFFFFF\n");
  const Derived result = derived(system, 100);
  QCOMPARE(result.generation, 6);
  QCOMPARE(result.stopped, str("generation 7 would make 10,000,000 modules (limit 2,000,000); showing generation 6"));
  QCOMPARE(result.modules.size(), std::size_t{1'000'000});
  const Result<Grown> grown = interpretInOrder(system, result.modules, {});
  QVERIFY(!grown);
  QCOMPARE(grown.error().message, str("the rules make more than 200000 links"));
}

void GrowLSystemTest::endlessRulesEnd() {
  const LSystem system = parsed("#iterations 1000\naxiom: AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA\nA -> [A]A\n");
  const Derived nested = derived(system, 1000);
  QVERIFY(!nested.stopped.empty());
  const LSystem same = parsed("axiom: A\nA -> A\n");
  const Derived still = derived(same, 1000);
  QCOMPARE(still.generation, 1000);
  QCOMPARE(still.modules.size(), std::size_t{1});
}

void GrowLSystemTest::nonsenseWhileDerivingIsAnError() {
  Progress progress;
  const LSystem zero = parsed("axiom: A(1)\nA(k) -> A(1/(k-1))\n");
  const Result<Derived> division = derive(zero, 3, 1, {}, progress);
  QVERIFY(!division);
  QCOMPARE(division.error().message, str("2:11: division by zero"));
  const LSystem huge = parsed("axiom: A(10)\nA(k) -> A(k**k)\n");
  const Result<Derived> infinite = derive(huge, 5, 1, {}, progress);
  QVERIFY(!infinite);
  QCOMPARE(infinite.error().message, str("2:11: this is no number any more"));
  const LSystem far = parsed("axiom: F(1000)\n");
  QVERIFY(!interpretInOrder(far, derived(far, 0).modules, {}));
}

void GrowLSystemTest::cutsRemoveTheRestOfTheirBranch() {
  const LSystem system = parsed("axiom: F[+AFF[-F]F]F\nA -> %\n");
  QCOMPARE(namesOf(system, derived(system, 1).modules), str("F[+]F"));
}

void GrowLSystemTest::hostileTextIsRefused() {
  QVERIFY(!firstError(std::string(70'000, 'F')).empty());
  QVERIFY(!firstError("axiom: F(" + std::string(5'000, '(')).empty());
  QVERIFY(!firstError("axiom: F(" + std::string(5'000, '-') + "1)").empty());
  QVERIFY(!firstError(QByteArray("axiom: F\0F", 10).toStdString()).empty());
  QVERIFY(!firstError("axiom: F(1e999)").empty());
  QVERIFY(!firstError("").empty());
}

WINDFALL_SUITE(GrowLSystemTest)
#include "grow_lsystem.moc"
