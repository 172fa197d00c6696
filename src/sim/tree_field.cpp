#include "sim/tree_field.h"

#include <algorithm>
#include <cmath>

#include "kernels/link_coupled.h"
#include "kernels/link_forces.h"
#include "kernels/link_modal.h"

namespace windfall::sim {

namespace {

/// Sizes of a method's blocks and rows.
struct Layout {
  std::uint32_t constants, variables, sumRow;
};

template <class Solver>
constexpr Layout kLayoutOf{Solver::kConstants, Solver::kVariables, Solver::kSumRow};

Layout layoutOf(const FactorSettings& settings) {
  if (settings.method == TreeMethod::Coupled) return kLayoutOf<CoupledSolver>;
  if (settings.method == TreeMethod::Forces) return kLayoutOf<ForcesSolver>;
  return usesAxes(settings) ? kLayoutOf<AxisSolver> : kLayoutOf<ModalSolver>;
}

const LinkPasses& passesOf(const FactorSettings& settings) {
  const LinkLoops& loops = linkLoops();
  if (settings.method == TreeMethod::Coupled) return loops.coupled;
  if (settings.method == TreeMethod::Forces) return loops.forces;
  return usesAxes(settings) ? loops.axis : loops.modal;
}

}  // namespace

TreeField::TreeField(std::vector<TreeInstance> trees, const FactorSettings& settings, int threads, const FieldCut& cut)
    : trees_(std::move(trees)), settings_(settings), threads_(std::max(threads, 1)) {
  for (const TreeInstance& instance : trees_) {
    const auto first = static_cast<std::uint32_t>(parents_.size());
    firstLinks_.push_back(first);
    for (const Link& link : instance.tree->links) {
      parents_.push_back(link.parent < 0 ? -1 : link.parent + static_cast<std::int32_t>(first));
    }
  }
  slots_ = arrange(parents_, cut.treelet, cut.part, cut.width);
  const Layout layout = layoutOf(settings);
  constantFields_ = layout.constants;
  stateFields_ = layout.variables;
  sumRow_ = layout.sumRow;
  const std::size_t count = slots_.link.size();
  findBases();
  constants_.assign(count * constantFields_, 0.f);
  state_.assign(count * stateFields_, 0.f);
  air_.assign(count * 3, 0.f);
  sums_.assign(std::size_t{slots_.sumRows} * sumRow_, 0.f);
  moves_.assign(settings.method == TreeMethod::Coupled ? std::size_t{slots_.rows} * kMoveRow : 0, 0.f);
  before_.resize(slots_.rows);
  after_.resize(slots_.rows);
  inertia_.resize(settings.method == TreeMethod::Coupled ? size() : 0);
  nextConstants_ = constants_;
  nextInertia_ = inertia_;
  initialise(constants_);
  initialise(nextConstants_);
  for (std::size_t slot = 0; slot < count; ++slot) {
    if (slots_.link[slot] >= slots_.links) {
      fieldsOf(state_.data(), stateFields_, static_cast<std::uint32_t>(slot)).put(kTurn + 3, 1);
    }
  }
  lostArea_.resize(size());
  nextLostArea_.resize(size());
  made_.resize(trees_.size());
  for (const TreeInstance& instance : trees_) {
    factors_.push_back(makeFactors(*instance.tree, settings));
    frequencies_.push_back(settings.frequency > 0 ? settings.frequency : firstFrequency(*instance.tree));
  }
  factorise(settings);
  reset();
}

void TreeField::findBases() {
  if (!usesAxes(settings_)) return;
  std::vector<std::uint32_t> ofLink(size(), slots_.ground());
  std::size_t i = 0;
  for (const TreeInstance& instance : trees_) {
    const std::vector<Link>& links = instance.tree->links;
    for (const Link& link : links) {
      if (parents_[i] >= 0) {
        const auto parent = static_cast<std::size_t>(parents_[i]);
        const bool continues = links[static_cast<std::size_t>(link.parent)].chain == link.chain;
        ofLink[i] = continues ? ofLink[parent] : static_cast<std::uint32_t>(parent);
      }
      ++i;
    }
  }
  for (const std::uint32_t row : slots_.link) bases_.push_back(row < slots_.links ? ofLink[row] : row);
}

float TreeField::constant(std::size_t link, std::uint32_t field) const {
  return fieldsOf(constants_.data(), constantFields_, slots_.slot[link]).get(field);
}

vec3 TreeField::variable(std::size_t link, std::uint32_t first) const {
  const SlotFields<const float> fields = fieldsOf(state_.data(), stateFields_, slots_.slot[link]);
  return {fields.get(first), fields.get(first + 1), fields.get(first + 2)};
}

LinkShape TreeField::shape(std::size_t link) const {
  const SlotFields<const float> f = fieldsOf(constants_.data(), constantFields_, slots_.slot[link]);
  const auto vector = [&](std::uint32_t at) { return vec3(f.get(at), f.get(at + 1), f.get(at + 2)); };
  LinkShape shape;
  shape.halfLength = f.get(kHalf);
  shape.weight = f.get(kWeight);
  shape.woodDrag = f.get(kWoodDrag);
  shape.leafDrag = f.get(kLeafDrag);
  shape.restRotation = vec4(vector(kRestTurn), f.get(kRestTurn + 3));
  shape.restOffset = vector(kRestOffset);
  shape.stiffness = vec3(f.get(kBending), f.get(kBending), f.get(kTwist));
  shape.preStress = vector(kPreStress);
  shape.parent = parents_[link];
  return shape;
}

void TreeField::reset() {
  const vec3 zero(0);
  for (std::size_t i = 0; i < size(); ++i) setJoint(i, zero);
  std::fill(sums_.begin(), sums_.end(), 0.f);
  pose();
}

void TreeField::setJoint(std::size_t link, const vec3& angle, const vec3& speed) {
  const SlotFields<float> fields = fieldsOf(state_.data(), stateFields_, slots_.slot[link]);
  for (std::uint32_t k = 0; k < 3; ++k) {
    fields.put(kAngle + k, angle[static_cast<int>(k)]);
    fields.put(kSpeed + k, speed[static_cast<int>(k)]);
  }
}

void TreeField::pose() {
  ++revision_;
  for (std::size_t i = 0; i < size(); ++i) {
    const SlotFields<const float> constant = fieldsOf<const float>(constants_.data(), constantFields_, slots_.slot[i]);
    const SlotFields<float> own = fieldsOf(state_.data(), stateFields_, slots_.slot[i]);
    const V3<float> angle = vectorAt<float>(own, kAngle), speed = vectorAt<float>(own, kSpeed);
    const bool root = parents_[i] < 0;
    const std::size_t parentRow = root ? slots_.ground() : static_cast<std::size_t>(parents_[i]);
    const LinkState& p = after_[parentRow];
    const Pose<float> parent{{p.rotation.x, p.rotation.y, p.rotation.z, p.rotation.w},
                             {p.position.x, p.position.y, p.position.z},
                             {p.velocity.x, p.velocity.y, p.velocity.z},
                             {p.angularVelocity.x, p.angularVelocity.y, p.angularVelocity.z}};
    const Pose<float> pose = posed(constant, own, parent, angle, speed);
    LinkState& state = after_[i];
    state.rotation = vec4(pose.turn.x, pose.turn.y, pose.turn.z, pose.turn.w);
    state.position = vec3(pose.place.x, pose.place.y, pose.place.z);
    state.velocity = vec3(pose.velocity.x, pose.velocity.y, pose.velocity.z);
    state.angularVelocity = vec3(pose.spin.x, pose.spin.y, pose.spin.z);
    if (isModal(settings_.method)) {
      toModes(i);
    } else if (settings_.method == TreeMethod::Coupled) {
      V3<float> spin = speed, velocity{0, 0, 0};
      if (!root) {
        const SlotFields<const float> above =
            fieldsOf<const float>(state_.data(), stateFields_, slots_.slot[parentRow]);
        const Turn<float> turn = turnAt<float>(constant, kRestTurn);
        const V3<float> o = vectorAt<float>(above, kSpin);
        spin = spin + turnedBack(turn, o);
        velocity =
            turnedBack(turn, vectorAt<float>(above, kVelocity) + crossOf(o, vectorAt<float>(constant, kRestOffset)));
      }
      putVector(own, kSpin, spin);
      putVector(own, kVelocity, velocity);
    }
  }
  before_ = after_;
}

std::vector<float> TreeField::state() const {
  std::vector<float> all;
  all.reserve(size() * stateFields_);
  for (std::size_t i = 0; i < size(); ++i) {
    const SlotFields<const float> fields = fieldsOf(state_.data(), stateFields_, slots_.slot[i]);
    for (std::uint32_t f = 0; f < stateFields_; ++f) all.push_back(fields.get(f));
  }
  return all;
}

void TreeField::setState(std::span<const float> state, std::span<const LinkState> before,
                         std::span<const LinkState> after) {
  ++revision_;
  for (std::size_t i = 0; i < size(); ++i) {
    const SlotFields<float> fields = fieldsOf(state_.data(), stateFields_, slots_.slot[i]);
    for (std::uint32_t f = 0; f < stateFields_; ++f) fields.put(f, state[i * stateFields_ + f]);
  }
  std::copy(before.begin(), before.end(), before_.begin());
  std::copy(after.begin(), after.end(), after_.begin());
  std::fill(sums_.begin(), sums_.end(), 0.f);
}

void TreeField::takeStep(AlignedVector<float>& state, AlignedVector<LinkState>& now) {
  state_.swap(state);
  before_.swap(after_);
  after_.swap(now);
  if (forced_) std::fill(sums_.begin(), sums_.end(), 0.f);
  forced_ = false;
}

LinkSlots<float> TreeField::view() {
  LinkSlots<float> view;
  view.link = slots_.link.data();
  view.parent = slots_.parent.data();
  view.target = slots_.target.data();
  view.base = bases_.data();
  view.constants = constants_.data();
  view.state = state_.data();
  view.air = air_.data();
  view.sums = sums_.data();
  view.moves = moves_.data();
  view.before = reinterpret_cast<const float*>(before_.data());
  view.after = reinterpret_cast<float*>(after_.data());
  view.constantFields = constantFields_;
  view.stateFields = stateFields_;
  return view;
}

LinkStep<float> TreeField::stepParameters() const {
  LinkStep<float> step;
  step.h = static_cast<float>(settings_.h);
  step.implicitness = static_cast<float>(settings_.implicitness);
  step.geometric = settings_.method == TreeMethod::Literal ? 0.f : 1.f;
  return step;
}

void TreeField::follow(const LinkPull& pull) { pull_ = {pull.link, pull.force, pull.arm}; }

void TreeField::addForces() {
  addForce(pull_);
  pull_ = {};
  for (const LinkForce& f : forces_) addForce(f);
  forces_ = {};
}

void TreeField::addForce(const LinkForce& f) {
  if (f.link >= size()) return;
  forced_ = true;
  vec3 torque = glm::cross(f.arm, f.force);
  float* row = sums_.data() + std::size_t{f.link} * sumRow_;
  if (settings_.method == TreeMethod::Forces) {
    torque = rotateBack(after_[f.link].rotation, torque);
  } else {
    for (int k = 0; k < 3; ++k) row[k] += f.force[k];
    row += 3;
    if (isModal(settings_.method)) row[3] += glm::dot(f.arm, f.force);
  }
  for (int k = 0; k < 3; ++k) row[k] += torque[k];
}

std::span<const float> TreeField::outside() {
  addForces();
  return forced_ ? std::span<const float>(sums_).first(std::size_t{slots_.rows} * sumRow_) : std::span<const float>();
}

void TreeField::sampleAir(const WindView& wind) {
  LinkSlots<float> links = view();
  links.before = reinterpret_cast<const float*>(after_.data());
  follow(wind.pull);
  const LinkAir sample = linkLoops().air;
  // Pieces of constants first: they take longer than a part's air.
  const auto pieces = static_cast<std::ptrdiff_t>(renewing_ ? trees_.size() : 0);
  const auto parts = static_cast<std::ptrdiff_t>(slots_.parts.size());
#pragma omp parallel for schedule(dynamic) num_threads(threads_) if (parts > 3)
  for (std::ptrdiff_t p = -pieces; p < parts; ++p) {
    if (p < 0) {
      renewOn(static_cast<std::size_t>(-p - 1));
      continue;
    }
    const Part part = slots_.parts[static_cast<std::size_t>(p)];
    sample(links, wind, part.begin, part.end, air_.data());
  }
  if (renewing_) takeFactors();
}

void TreeField::crossTop(const LinkSlots<float>& links, const LinkStep<float>& step) {
  const LinkPass up = passesOf(settings_).up;
  const auto cross = [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t c = begin; c < end; ++c) {
      float* from = links.sums + std::size_t{slots_.crossings[c].from} * sumRow_;
      float* to = links.sums + std::size_t{slots_.crossings[c].to} * sumRow_;
      const bool kept = slots_.crossings[c].to != slots_.ground();
      for (std::uint32_t k = 0; k < sumRow_; ++k) {
        if (kept) to[k] += from[k];
        from[k] = 0;
      }
    }
  };
  const Part top = slots_.parts.front();
  for (std::uint32_t block = top.end; block-- > top.begin;) {
    cross(slots_.before[block - top.begin], slots_.before[block - top.begin + 1]);
    up(links, step, block, block + 1);
  }
  cross(slots_.before.back(), static_cast<std::uint32_t>(slots_.crossings.size()));
}

void TreeField::solve() {
  if (size() == 0) return;
  addForces();
  forced_ = false;
  before_.swap(after_);
  const LinkSlots<float> links = view();
  const LinkStep<float> step = stepParameters();
  const LinkPasses passes = passesOf(settings_);
  const auto parts = static_cast<std::ptrdiff_t>(slots_.parts.size());
  const auto part = [&](std::ptrdiff_t p) { return slots_.parts[static_cast<std::size_t>(p)]; };
#pragma omp parallel num_threads(threads_) if (parts > 3)
  {
#pragma omp for schedule(dynamic)
    for (std::ptrdiff_t p = 1; p < parts; ++p) passes.up(links, step, part(p).begin, part(p).end);
#pragma omp single
    {
      crossTop(links, step);
      passes.down(links, step, part(0).begin, part(0).end);
    }
#pragma omp for schedule(dynamic)
    for (std::ptrdiff_t p = 1; p < parts; ++p) passes.down(links, step, part(p).begin, part(p).end);
  }
}

double TreeField::kineticEnergy() const {
  double sum = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const vec3 rate = speed(i);
    if (settings_.method == TreeMethod::Coupled) {
      const LinkInertia& body = inertia_[i];
      const float r = constant(i, kHalf);
      const vec3 o = variable(i, kSpin), v = variable(i, kVelocity) + vec3(o.y * r, -o.x * r, 0);
      sum += 0.5 * static_cast<double>(body.mass * glm::dot(v, v) + body.across * (o.x * o.x + o.y * o.y) +
                                       body.along * o.z * o.z + body.floor * rate.z * rate.z);
    } else if (isModal(settings_.method)) {
      const vec3 y = variable(i, kModeSpeed);
      for (std::uint32_t a = 0; a < 3; ++a) {
        const float value = y[static_cast<int>(a)];
        sum += 0.5 * static_cast<double>(value * value / constant(i, kSquares + a));
      }
    } else {
      sum += 0.5 * static_cast<double>(constant(i, kInertia) * (rate.x * rate.x + rate.y * rate.y) +
                                       constant(i, kTwistInertia) * rate.z * rate.z);
    }
  }
  return sum;
}

double TreeField::elasticEnergy() const {
  double sum = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const vec3 a = angle(i);
    sum += 0.5 * static_cast<double>(constant(i, kBending) * (a.x * a.x + a.y * a.y) + constant(i, kTwist) * a.z * a.z);
  }
  return sum;
}

float TreeField::largestAngle() const {
  float largest = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const vec3 a = angle(i);
    const float square = glm::dot(a, a);
    // Written so that not a number is kept.
    if (!(square <= largest)) largest = square;
  }
  return std::sqrt(largest);
}

std::size_t TreeField::bytes() const {
  const auto of = [](const auto& v) { return v.size() * sizeof(v[0]); };
  std::size_t sum = of(constants_) + of(state_) + of(air_) + of(sums_) + of(moves_) + of(before_) + of(after_) +
                    of(slots_.link) + of(slots_.parent) + of(slots_.target) + of(nextConstants_) + of(inertia_) +
                    of(nextInertia_) + of(lostArea_) + of(nextLostArea_);
  for (const std::unique_ptr<FactorPass>& factors : factors_) sum += factors->bytes();
  return sum;
}

}  // namespace windfall::sim
