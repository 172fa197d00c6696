#include "model/plant/grow/grow_skeleton.h"

#include <QObject>
#include <algorithm>
#include <cmath>

#include "model/plant/grow/colonization.h"
#include "model/plant/grow/crown_volume.h"
#include "model/plant/grow/growth_events.h"
#include "model/plant/grow/lsystem.h"
#include "model/plant/grow/self_organizing.h"
#include "model/plant/grow/shoots.h"
#include "model/progress_part.h"

namespace windfall::model::growth {

namespace {

constexpr int kMostYears = 200;

bool within(double value, double low, double high) { return value >= low && value <= high; }

Status check(const GrowerSettings& s) {
  if (!within(s.height, 0.05, 120)) return Error{"the height must be 0.05 to 120 m"};
  if (!within(s.baseRadius, 0.0005, 5)) return Error{"the trunk's radius must be 0.5 mm to 5 m"};
  if (!within(s.wood.tipRadius, 1e-4, 0.5)) return Error{"the tips' radius must be 0.1 mm to 50 cm"};
  if (!within(s.age, 0, 10'000)) return Error{"the age must be 0 to 10,000 years"};
  if (!within(s.maturity, 0.1, 10'000)) return Error{"the age of maturity must be 0.1 to 10,000 years"};
  return ok();
}

Status check(const ColonizationSettings& s) {
  if (!within(s.step, 0.005, 10)) return Error{"the step must be 5 mm to 10 m"};
  if (!within(s.influence, 2 * s.step, 100 * s.step)) return Error{"the influence must be 2 to 100 steps"};
  if (!within(s.kill, 0, s.influence)) return Error{"the distance of use must lie below the influence"};
  if (!within(s.upward, -10, 10) || !within(s.noise, 0, 10) || !within(s.trunkWander, 0, 10)) {
    return Error{"pulls and noise must be numbers up to 10"};
  }
  if (!within(s.trunkTop, 0, 200)) return Error{"the trunk's top must be 0 to 200 m"};
  if (!within(s.lobes, 0, 1000) || !within(s.lobeSize, 0, 10) || !within(s.stems, 1, 64))
    return Error{"lobes or stems are out of range"};
  if (!within(s.hangingLength, 0, 50) || !within(s.hangingShare, 0, 1) || !within(s.hangingStep, 0.02, 10)) {
    return Error{"the hanging shoots are out of range"};
  }
  return ok();
}

Status check(const SelfOrganizingSettings& s, double height) {
  if (!within(s.rate, 1e-4, 10) || !within(s.power, 0.1, 10)) return Error{"the growth curve is out of range"};
  if (!within(s.internode, 0.005, 5)) return Error{"the internode must be 5 mm to 5 m"};
  if (std::pow(1.5 * height / s.internode, 2) * (1.15 * height + 1) / s.internode > 3e7) {
    return Error{"the internode is too short for a plant of this height"};
  }
  if (!within(s.vigour, 0, 100) || !within(s.leader, 0, 1)) return Error{"vigour or leader is out of range"};
  if (!within(s.density, 0, 10) || !within(s.falloff, 1, 10) || !within(s.shadowDepth, 0, 20))
    return Error{"the shadow is out of range"};
  if (!within(s.buds, 1, 12) || !within(s.basalBuds, 0, 30) || !within(s.longestShoot, 1, 50))
    return Error{"the buds are out of range"};
  if (!within(s.angle, 0, 180) || !within(s.light, 0, 10) || !within(s.upward, -10, 10) || !within(s.level, 0, 10)) {
    return Error{"angle or pulls are out of range"};
  }
  if (!within(s.apical, 0, 10) || !within(s.leastWeight, 0, 1) || !within(s.favoured, 0, 1) ||
      !within(s.pruning, 0, 100) || !within(s.bole, 0, 1) || !within(s.reach, 0, 10)) {
    return Error{"shares must be 0 to 1"};
  }
  return ok();
}

/// The last round by which at most `share` of the nodes exist (1.6).
int roundOf(const Grown& grown, double share) {
  std::vector<int> births = grown.birth;
  std::sort(births.begin(), births.end());
  const auto most = static_cast<std::size_t>(share * static_cast<double>(births.size()));
  if (most >= births.size()) return births.back();
  // The seeded trunk is always there.
  return std::max(births[most] - 1, 0);
}

Result<GrownSkeleton> byColonization(const Plant& plant, std::vector<char>& done, Progress& progress) {
  const GrowerSettings& s = *plant.grower;
  const std::vector<HandEdit>& edits = plant.handEdits;
  const ColonizationSettings& c = s.colonization;
  if (const Status good = check(c); !good) return good.error();
  ProgressPart sampling(progress, 0, 0.2), growing(progress, 0.2, 0.9);
  Result<std::vector<dvec3>> points = crownPoints(c, plant.crown, s.height, s.seed, sampling);
  if (!points) return points.error();
  Result<Grown> chain = seedTrunks(c, s.height, *points, s.seed);
  if (!chain) return chain.error();
  const std::size_t wanted = points->size();
  Colonized colony = colonize(c, *points, *chain, s.seed, {}, growing);
  const double size = maturityShare(s);
  const auto roundAt = [births = colony.grown](double share) { return roundOf(births, share * share); };
  if (!edits.empty()) {
    const std::vector<GrowthEvent> events = eventsOfColonization(s, edits, roundAt, done);
    if (!events.empty()) {
      colony = colonize(c, std::move(*points), *chain, s.seed, events, growing);
    }
  }
  if (progress.cancelled()) return Error{"cancelled", true};
  GrownSkeleton out;
  out.grown = std::move(colony.grown);
  Grown& g = out.grown;
  const int round = roundAt(size);
  std::vector<char> keep(g.size());
  std::transform(g.birth.begin(), g.birth.end(), keep.begin(), [&](int birth) { return birth <= round ? 1 : 0; });
  if (size < 1) keepOnly(g, keep);
  relocate(g);
  mergeStraight(g, 8, 0.6);
  pipeRadii(g, s.wood.tipRadius, 0);
  chooseAxes(g);
  smooth(g, 2);
  const double scale = std::sqrt(size);
  for (dvec3& place : g.position) place *= scale;
  hangShoots(g, c, size, s.seed);
  setRadii(g, s.wood.tipRadius, s.baseRadius * std::pow(size, 1.2));
  breakTwigs(g, s.wood.breakage, s.seed);
  const auto all = static_cast<double>(wanted);
  if (colony.left > 0.05 * all)
    out.notes << QObject::tr("%1 % of the crown's points are out of reach").arg(qRound(100 * colony.left / all));
  return out;
}

Result<GrownSkeleton> bySelfOrganizing(const GrowerSettings& s, const std::vector<HandEdit>& edits,
                                       std::vector<char>& done, Progress& progress) {
  if (const Status good = check(s.selfOrganizing, s.height); !good) return good.error();
  const int years = std::clamp(static_cast<int>(std::lround(s.age)), 1, kMostYears);
  const std::vector<GrowthEvent> events = eventsOfYears(edits, years, done);
  SelfOrganized made = selfOrganize(s.selfOrganizing, s.height, years, s.seed, events, progress);
  if (progress.cancelled()) return Error{"cancelled", true};
  if (made.grown.size() < 2) return Error{"nothing grew: there is too little vigour or too much shade"};
  GrownSkeleton out;
  out.grown = std::move(made.grown);
  const double size = grownHeight(s.selfOrganizing, s.height, years) /
                      std::max(grownHeight(s.selfOrganizing, s.height, s.maturity), 1e-9);
  setRadii(out.grown, s.wood.tipRadius, s.baseRadius * std::pow(std::min(size, 2.0), 1.2));
  breakTwigs(out.grown, s.wood.breakage, s.seed);
  if (made.full) out.notes << QObject::tr("growth was stopped at 300,000 nodes");
  return out;
}

Result<GrownSkeleton> byRules(const GrowerSettings& s, Progress& progress) {
  const double size = maturityShare(s);
  const std::string text = s.lSystem.rules.toStdString();
  const Parsed parsed = parseRules(text, size);
  if (!parsed.errors.empty()) return Error{"rules " + parsed.errors.front().text()};
  const LSystem& system = parsed.system;
  const int whole = s.lSystem.iterations > 0 ? s.lSystem.iterations : system.iterations;
  const bool knowsAge = text.find("age") != std::string::npos;
  const int generations = knowsAge ? whole : static_cast<int>(std::lround(whole * size));
  const LSystemLimits limits;
  Result<Derived> derived =
      derive(system, generations, system.hasSeed ? system.seed ^ (s.seed - 1) : s.seed, limits, progress);
  if (!derived) return Error{"rules " + derived.error().message, derived.error().cancelled};
  Result<Grown> grown = interpret(system, derived->modules, limits, progress);
  if (!grown) return Error{"rules: " + grown.error().message, grown.error().cancelled};
  if (grown->size() < 2) return Error{"the rules draw no link: they need an F"};
  GrownSkeleton out;
  out.grown = std::move(*grown);
  if (!derived->stopped.empty()) out.notes << QString::fromStdString(derived->stopped);
  Grown& g = out.grown;
  if (std::any_of(g.radius.begin(), g.radius.end(), [](double r) { return r > 0; })) {
    for (double& radius : g.radius) radius = radius > 0 ? radius : 0.5 * system.width;
    for (std::size_t i = g.size(); i-- > 1;)
      g.radius[at(g.parent[i])] = std::max(g.radius[at(g.parent[i])], g.radius[i]);
  } else {
    setRadii(g, s.wood.tipRadius, s.baseRadius * std::pow(size, 1.2));
  }
  chooseAxes(g);
  return out;
}

}  // namespace

double maturityShare(const GrowerSettings& settings) { return shareAt(settings, settings.age); }

double shareAt(const GrowerSettings& s, double age) {
  constexpr double kRate = 2.5, kPower = 1.2;
  const double t = std::clamp(age / std::max(s.maturity, 1e-9), 0.0, 1.0);
  const double share = std::pow((1 - std::exp(-kRate * t)) / (1 - std::exp(-kRate)), kPower);
  return std::clamp(share, 0.03, 1.0);
}

Result<GrownSkeleton> growSkeleton(const Plant& plant, Progress& progress) {
  if (!plant.grower) return Error{"is not grown"};
  const GrowerSettings& settings = *plant.grower;
  const std::vector<HandEdit>& edits = plant.handEdits;
  if (const Status good = check(settings); !good) return good.error();
  std::vector<char> done(edits.size(), 0);
  Result<GrownSkeleton> grown = settings.method == GrowMethod::SpaceColonization ? byColonization(plant, done, progress)
                                : settings.method == GrowMethod::SelfOrganizing
                                    ? bySelfOrganizing(settings, edits, done, progress)
                                    : byRules(settings, progress);
  if (!grown) return grown;
  std::vector<HandEdit> now = edits;
  if (settings.method == GrowMethod::SpaceColonization) {
    for (HandEdit& edit : now) scaleEdit(edit, std::sqrt(maturityShare(settings) / shareAt(settings, edit.age)));
  }
  grown->lost = applyEdits(grown->grown, now, done);
  for (const int index : grown->lost) grown->notes << QObject::tr("edit %1 found no branch to work on").arg(index + 1);
  return grown;
}

}  // namespace windfall::model::growth
