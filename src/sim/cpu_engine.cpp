#include "sim/cpu_engine.h"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "kernels/rotation.h"
#include "sim/state_bytes.h"

namespace windfall::sim {

namespace {

/// Box around everything that can move, with room to sway and to be blown away, m.
struct Box {
  vec3 lower{-5, 0, -5}, upper{5, 10, 5};
};

Box windBox(const SceneDescription& scene) {
  Box box;
  for (const TreeInstance& instance : scene.trees) {
    const quat turn = glm::angleAxis(instance.placement.heading, vec3(0, 1, 0));
    for (const Link& link : instance.tree->links) {
      const vec3 joint = instance.placement.position + turn * link.joint;
      const vec3 tip = joint + turn * (link.rotation * vec3(0, 0, link.length));
      box.lower = glm::min(box.lower, glm::min(joint, tip));
      box.upper = glm::max(box.upper, glm::max(joint, tip));
    }
  }
  box.upper.y = std::max(box.upper.y * 1.15f, scene.leaves.spawnHeight) + 1;
  const float side = 3 + 0.3f * box.upper.y;
  box.lower = vec3(box.lower.x - side, 0, box.lower.z - side);
  box.upper += vec3(side, 0, side);
  return box;
}

/// What slows the wind: leaves at the middle of their link, and the wood itself.
std::vector<Foliage> foliageOf(const SceneDescription& scene) {
  std::vector<Foliage> foliage;
  for (const TreeInstance& instance : scene.trees) {
    const quat turn = glm::angleAxis(instance.placement.heading, vec3(0, 1, 0));
    for (const Link& link : instance.tree->links) {
      const vec3 middle = link.joint + link.rotation * vec3(0, 0, 0.5f * link.length);
      foliage.push_back({instance.placement.position + turn * middle, link.leafArea + 2 * link.radius * link.length});
    }
  }
  return foliage;
}

WindField makeWind(const SceneDescription& scene, int threads) {
  const Box box = windBox(scene);
  WindField wind(box.lower, box.upper, scene.wind, threads);
  wind.setFoliage(foliageOf(scene));
  return wind;
}

FactorSettings settingsOf(const SceneDescription& scene, const WindField& wind, double time) {
  FactorSettings settings;
  settings.h = static_cast<double>(scene.solver.step);
  settings.method = scene.solver.method;
  settings.axisMotion = scene.solver.axisMotion;
  settings.dampingRatio = static_cast<double>(scene.solver.structuralDamping);
  settings.windSpeed = static_cast<double>(wind.level(time));
  settings.windDirection = glm::dvec3(wind.direction(time));
  return settings;
}

class Stopwatch {
 public:
  /// Milliseconds since the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - start_).count();
    start_ = now;
    return ms;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

constexpr std::int64_t kLeafInterval = 30;  // steps between looks at what has fallen
constexpr double kLeafShare = 0.02;         // of all leaves, before masses and drags follow (9)

/// OpenMP's number of threads for parallel regions of the caller, put back at the end.
class ThreadScope {
 public:
  explicit ThreadScope(int threads) : before_(omp_get_max_threads()) { omp_set_num_threads(threads); }
  ~ThreadScope() { omp_set_num_threads(before_); }
  ThreadScope(const ThreadScope&) = delete;
  ThreadScope& operator=(const ThreadScope&) = delete;

 private:
  int before_;
};

vec4 plain(const quat& q) { return {q.x, q.y, q.z, q.w}; }

}  // namespace

CpuEngine::CpuEngine(SceneDescription scene, int threads, const FieldCut& cut)
    : scene_(std::move(scene)),
      threads_(threads > 0 ? threads : omp_get_max_threads()),
      wind_(makeWind(scene_, threads_)),
      trees_(scene_.trees, settingsOf(scene_, wind_, 0), threads_, cut),
      leaves_(scene_),
      lostArea_(trees_.size(), 0.f) {
  float highest = -1e30f;
  for (const TreeInstance& instance : scene_.trees) {
    for (const Link& link : instance.tree->links) {
      restRotations_.push_back(inverse(plain(link.rotation)));
      restPositions_.push_back(link.joint);
      leafArea_ += static_cast<double>(link.leafArea);
      const std::size_t index = restPositions_.size() - 1;
      const LinkState& state = trees_.current()[index];
      const vec3 tip = placeOf(state, vec3(0, 0, link.length));
      if (tip.y > highest) {
        highest = tip.y;
        tipLink_ = index;
        tipRest_ = tip;
      }
    }
  }
  wind_.advance(0);
}

double CpuEngine::time() const { return static_cast<double>(steps_) * stepLength(); }

FactorSettings CpuEngine::factorSettings() const { return settingsOf(scene_, wind_, time()); }

namespace {
bool isSameWind(const FactorSettings& a, const FactorSettings& b) {
  return a.windSpeed == b.windSpeed && a.windDirection == b.windDirection;
}
}  // namespace

/// In a step: the constants come some steps later.
void CpuEngine::followWind() {
  const FactorSettings wanted = factorSettings();
  if (!isSameWind(wanted, trees_.settings())) trees_.renew(wanted, lostArea_);
}

/// Outside of steps: at once.
void CpuEngine::takeWind() {
  const FactorSettings wanted = factorSettings();
  if (trees_.isRenewing() || !isSameWind(wanted, trees_.settings())) trees_.factorise(wanted);
}

LinkView CpuEngine::linkView() const {
  return {trees_.previous().data(), trees_.current().data(), static_cast<std::uint32_t>(trees_.size())};
}

void CpuEngine::followLeaves() {
  if (steps_ % kLeafInterval != 0 || !leaves_.findLostArea(lostArea_)) return;
  double change = 0;
  for (std::size_t i = 0; i < lostArea_.size(); ++i) {
    change += static_cast<double>(std::abs(lostArea_[i] - trees_.lostArea()[i]));
  }
  if (change > kLeafShare * leafArea_) trees_.renew(trees_.settings(), lostArea_);
}

void CpuEngine::step() {
  Stopwatch watch;
  const double h = stepLength();
  const ThreadScope scope(threads_);
  followWind();
  wind_.advance(time() + 0.5 * h);
  if (pull_.isHeld()) wind_.setPull(pull_.next(trees_, static_cast<float>(h)));
  const double windLattice = timers_.wind = watch.lap();
  moveTrees(trees_, wind_.view());
  // The air at the links counts as wind.
  timers_.trees = watch.lap() - (timers_.wind - windLattice);
  leaves_.step(time(), static_cast<float>(h), linkView(), wind_.view());
  ++steps_;
  followLeaves();
  timers_.leaves = watch.lap();
  between_ = 1;
}

void CpuEngine::moveTrees(TreeField& trees, const WindView& wind) {
  Stopwatch watch;
  trees.sampleAir(wind);
  timers_.wind += watch.lap();
  trees.solve();
}

void CpuEngine::reset() {
  steps_ = 0;
  accumulator_ = 0;
  between_ = 1;
  wind_.restore({});
  leaves_.reset();
  forgetLeaves();
  trees_.reset();
  takeWind();
  wind_.advance(0);
}

void CpuEngine::setWind(const WindSettings& wind) {
  if (wind == wind_.settings()) return;
  wind_.set(wind, time());
  scene_.wind = wind;
}

void CpuEngine::setLeaves(const LeafSettings& leaves) {
  if (leaves == scene_.leaves) return;
  scene_.leaves = leaves;
  if (leaves_.setSettings(leaves)) forgetLeaves();
}

void CpuEngine::forgetLeaves() {
  std::fill(lostArea_.begin(), lostArea_.end(), 0.f);
  const std::span<const float> known = trees_.lostArea();
  if (std::any_of(known.begin(), known.end(), [](float area) { return area != 0; })) trees_.setLostArea(lostArea_);
}

void CpuEngine::setTree(std::size_t instance, std::shared_ptr<const Tree> tree) {
  if (instance >= scene_.trees.size() || !tree || tree->links.size() != scene_.trees[instance].tree->links.size())
    return;
  if (!problemOf(*tree).empty()) return;
  scene_.trees[instance].tree = tree;
  trees_.setTree(instance, std::move(tree));
}

std::size_t CpuEngine::leafCount() const { return leaves_.size(); }

void CpuEngine::write(std::span<mat4> boneMatrices, std::span<LeafInstance> leaves) {
  Stopwatch watch;
  const float f = static_cast<float>(between_);
  const std::span<const LinkState> before = trees_.previous(), after = trees_.current();
  const auto count = static_cast<std::ptrdiff_t>(std::min(boneMatrices.size(), after.size()));
#pragma omp parallel for schedule(static) num_threads(threads_) if (count > 4096)
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const vec4& a = before[i].rotation;
    vec4 b = after[i].rotation;
    if (glm::dot(a, b) < 0) b = -b;
    const vec4 mixed = glm::normalize(a * (1 - f) + b * f);
    const vec3 position = before[i].position * (1 - f) + after[i].position * f;
    const vec4 turn = compose(mixed, restRotations_[i]);
    const quat q(turn.w, turn.x, turn.y, turn.z);
    mat4 bone = glm::mat4_cast(q);
    bone[3] = vec4(position - rotate(turn, restPositions_[i]), 1);
    boneMatrices[i] = bone;
  }
  if (leaves.size() == leaves_.size()) leaves_.write(f, linkView(), leaves);
  timers_.output = watch.lap();
}

Statistics CpuEngine::statistics() const {
  Statistics s;
  s.time = time();
  if (trees_.size() > 0) {
    const LinkState& state = trees_.current()[tipLink_];
    const float length = 2 * trees_.shape(tipLink_).halfLength;
    s.tipDisplacement = glm::length(placeOf(state, vec3(0, 0, length)) - tipRest_);
  }
  s.largestAngle = trees_.largestAngle();
  s.kineticEnergy = trees_.kineticEnergy();
  s.elasticEnergy = trees_.elasticEnergy();
  const LeafCounts counts = leaves_.counts();
  s.attached = counts.attached;
  s.airborne = counts.airborne;
  s.grounded = counts.grounded;
  s.fallTimeSum = leaves_.fallTimeSum();
  s.landed = leaves_.landed();
  return s;
}

DeviceInfo CpuEngine::device() const {
  return {Device::Cpu, "CPU, " + std::to_string(threads_) + (threads_ == 1 ? " thread" : " threads")};
}

std::uint64_t CpuEngine::hash() const {
  std::uint64_t h = kHashStart;
  for (std::size_t i = 0; i < trees_.size(); ++i) {
    const vec3 joint[] = {trees_.angle(i), trees_.speed(i)};
    h = hashBytes(joint, sizeof joint, h);
  }
  h = hashBytes(trees_.current().data(), trees_.current().size_bytes(), h);
  const std::uint64_t leaves = leaves_.hash();
  return hashBytes(&leaves, sizeof leaves, h);
}

namespace {
constexpr char kMagic[8] = {'W', 'i', 'n', 'd', 's', 't', 'a', 't'};
constexpr std::uint32_t kVersion = 3;
constexpr std::uint32_t kOldest = 2;  // knew no constants that are being made

bool allFinite(const void* data, std::size_t floats) {
  const auto* values = static_cast<const float*>(data);
  return std::all_of(values, values + floats, [](float v) { return std::isfinite(v); });
}

bool isSane(const TreeField::Renewal& renewal) {
  const auto isWind = [](double speed, const double(&d)[3]) {
    const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    return speed >= 0 && speed <= 2.0 * static_cast<double>(kMostWindSpeed) && square > 0.5 && square < 2;
  };
  return isWind(renewal.windSpeed, renewal.direction) && isWind(renewal.nextWindSpeed, renewal.nextDirection) &&
         renewal.pieces <= static_cast<std::int64_t>(TreeField::kFactorSteps) + 1;
}
}  // namespace

std::uint64_t CpuEngine::fingerprint() const {
  std::uint64_t h = hashBytes(&scene_.seed, sizeof scene_.seed);
  h = hashBytes(&scene_.solver.step, sizeof scene_.solver.step, h);
  h = hashBytes(&scene_.solver.method, sizeof scene_.solver.method, h);
  h = hashBytes(&scene_.solver.axisMotion, sizeof scene_.solver.axisMotion, h);
  for (const TreeInstance& instance : scene_.trees) {
    for (const Link& link : instance.tree->links) {
      const float numbers[] = {link.joint.x, link.joint.y, link.joint.z, link.length, link.radius};
      h = hashBytes(&link.parent, sizeof link.parent, h);
      h = hashBytes(numbers, sizeof numbers, h);
    }
  }
  return h;
}

std::vector<std::uint8_t> CpuEngine::save() const {
  ByteWriter body;
  body.value(fingerprint());
  body.value(steps_);
  body.value(accumulator_);
  body.value(wind_.anchor());
  const std::vector<float> motion = trees_.state();
  body.values(std::span<const float>(motion));
  body.values(trees_.previous());
  body.values(trees_.current());
  body.values(std::span<const float>(lostArea_));
  body.values(trees_.lostArea());
  body.values(std::span<const std::uint8_t>(leaves_.save()));
  body.value(trees_.renewal());
  body.values(trees_.nextLostArea());
  const std::vector<std::uint8_t> content = body.take();
  ByteWriter file;
  file.value(kMagic);
  file.value(kVersion);
  file.value(hashBytes(content.data(), content.size()));
  file.values(std::span<const std::uint8_t>(content));
  return file.take();
}

Status CpuEngine::restore(std::span<const std::uint8_t> bytes) {
  ByteReader file(bytes);
  char magic[8];
  std::uint32_t version = 0;
  std::uint64_t sum = 0, scene = 0;
  std::span<const std::uint8_t> content;
  if (!file.value(magic) || !std::equal(magic, magic + 8, kMagic)) return Error{"this is no state of a simulation"};
  if (!file.value(version)) return Error{"the state of the simulation is cut short"};
  if (version < kOldest || version > kVersion)
    return Error{"the state of the simulation is of version " + std::to_string(version) + ", not " +
                 std::to_string(kVersion)};
  if (!file.value(sum) || !file.block(content) || !file.atEnd())
    return Error{"the state of the simulation is cut short"};
  if (hashBytes(content.data(), content.size()) != sum) return Error{"the state of the simulation is damaged"};

  ByteReader body(content);
  if (!body.value(scene) || scene != fingerprint()) return Error{"the state belongs to another scene"};
  std::int64_t steps = 0;
  double accumulator = 0;
  WindAnchor anchor;
  std::vector<float> motion(trees_.state().size());
  std::vector<LinkState> before(trees_.size()), after(trees_.size());
  std::vector<float> lost(trees_.size()), known(trees_.size()), nextLost(trees_.size());
  TreeField::Renewal renewal;
  std::span<const std::uint8_t> leaves;
  const bool whole = body.value(steps) && body.value(accumulator) && body.value(anchor) &&
                     body.values(std::span(motion)) && body.values(std::span(before)) &&
                     body.values(std::span(after)) && body.values(std::span(lost)) && body.values(std::span(known)) &&
                     body.block(leaves) && (version < 3 || (body.value(renewal) && body.values(std::span(nextLost))));
  const double numbers[] = {accumulator,     anchor.time,   anchor.drift[0], anchor.drift[1],
                            anchor.drift[2], anchor.fronts, anchor.turnover};
  const bool sane =
      whole && steps >= 0 && steps < (std::int64_t{1} << 40) && accumulator >= 0 && accumulator <= stepLength() &&
      std::all_of(std::begin(numbers), std::end(numbers), [](double v) { return std::abs(v) < 1e12; }) &&
      allFinite(lost.data(), lost.size()) && allFinite(known.data(), known.size()) &&
      allFinite(nextLost.data(), nextLost.size()) && isSane(renewal) && allFinite(motion.data(), motion.size()) &&
      allFinite(before.data(), before.size() * sizeof(LinkState) / sizeof(float)) &&
      allFinite(after.data(), after.size() * sizeof(LinkState) / sizeof(float));
  if (!sane || !body.atEnd()) return Error{"the state of the simulation is damaged"};

  if (Status status = leaves_.restore(leaves); !status) return status.error();

  steps_ = steps;
  accumulator_ = accumulator;
  between_ = 1;
  wind_.restore(anchor);
  lostArea_ = lost;
  if (version < 3) {
    const FactorSettings settings = factorSettings();
    renewal.windSpeed = settings.windSpeed;
    for (int k = 0; k < 3; ++k) renewal.direction[k] = settings.windDirection[k];
  }
  trees_.resume(renewal, known, nextLost);
  trees_.setState(motion, before, after);
  poseWhereMoved();
  wind_.advance(std::max(0.0, time() - 0.5 * stepLength()));
  return ok();
}

}  // namespace windfall::sim
