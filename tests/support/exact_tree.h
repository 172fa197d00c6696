// A tree in double precision, stepped by the solvers' own arithmetic slot by slot (kernels/link_sweep.h): what tests
// measure energies, balances and the rounding of single precision with.
#pragma once

#include <functional>
#include <vector>

#include "kernels/link_sweep.h"
#include "sim/factor.h"
#include "sim/tree_field.h"

namespace windfall::test {

/// One tree at its place at rest; slots stand as the links do.
class ExactTree {
 public:
  /// Velocity of the air at a place, m/s, world.
  using Air = std::function<glm::dvec3(const glm::dvec3&)>;

  ExactTree(const sim::Tree& tree, const sim::FactorSettings& settings)
      : settings_(settings), count_(tree.links.size()), bodies_(sim::bodiesOf(tree)) {
    const bool axes = sim::usesAxes(settings);
    switch (settings.method) {
      case sim::TreeMethod::Coupled:
        layOut<CoupledSolver>();
        break;
      case sim::TreeMethod::Forces:
        layOut<ForcesSolver>();
        break;
      default:
        axes ? layOut<AxisSolver>() : layOut<ModalSolver>();
    }
    const std::size_t blocks = (count_ + kSlotBlock - 1) / kSlotBlock;
    constants_.resize(blocks * kSlotBlock * constantFields_);
    state_.resize(blocks * kSlotBlock * stateFields_);
    air_.resize(blocks * kSlotBlock * 3);
    sums_.resize((count_ + 1) * kRow);
    moves_.resize((count_ + 1) * kMoveRow);
    after_.resize((count_ + 1) * kRow);
    after_[count_ * kRow + 3] = 1;  // the ground's turn
    begin_.assign(count_ + 1, 0);
    for (std::size_t i = 0; i < count_; ++i) {
      const sim::LinkBody& body = bodies_[i];
      link_.push_back(static_cast<std::uint32_t>(i));
      parent_.push_back(static_cast<std::uint32_t>(body.parent < 0 ? static_cast<int>(count_) : body.parent));
      base_.push_back(body.continues ? base_[static_cast<std::size_t>(body.parent)] : parent_.back());
    }
    for (std::size_t i = 0; i < count_; ++i) {
      begin_[i] = static_cast<std::uint32_t>(children_.size());
      for (std::size_t c = i + 1; c < count_; ++c) {
        if (parent_[c] == i) children_.push_back(static_cast<std::uint32_t>(c));
        if (parent_[c] < i || parent_[c] == count_) break;  // the end of the subtree
      }
    }
    begin_[count_] = static_cast<std::uint32_t>(children_.size());
    const double frequency = settings.frequency > 0 ? settings.frequency : sim::firstFrequency(bodies_);
    Sink sink(*this);
    sim::factorise({&tree, {}, {}, frequency, settings}, sink);
    const std::vector<sim::Composite> composites = sim::compositesOf(bodies_);
    for (std::size_t i = 0; i < count_; ++i) {
      floor_.push_back(settings.twistFloor ? sim::twistFloor(bodies_[i], composites[i]) : 0);
    }
    pose();
  }

  std::size_t size() const { return count_; }
  const std::vector<sim::LinkBody>& bodies() const { return bodies_; }
  glm::dvec3 angle(std::size_t i) const { return variable(i, kAngle); }
  glm::dvec3 speed(std::size_t i) const { return variable(i, kSpeed); }
  glm::dvec3 place(std::size_t i) const { return {after_[i * kRow + 4], after_[i * kRow + 5], after_[i * kRow + 6]}; }
  glm::dquat turn(std::size_t i) const {
    const double* q = after_.data() + i * kRow;
    return {q[3], q[0], q[1], q[2]};
  }
  /// A point of a link's own frame, world.
  glm::dvec3 placeOf(std::size_t i, const glm::dvec3& local) const { return place(i) + turn(i) * local; }
  glm::dvec3 tip(std::size_t i) const { return placeOf(i, {0, 0, bodies_[i].length}); }
  double constant(std::size_t i, std::uint32_t field) const { return constantsOf(i).get(field); }

  /// Sets a joint; `pose` must follow.
  void setJoint(std::size_t i, const glm::dvec3& angle, const glm::dvec3& speed = glm::dvec3(0)) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      stateOf(i).put(kAngle + k, angle[static_cast<int>(k)]);
      stateOf(i).put(kSpeed + k, speed[static_cast<int>(k)]);
    }
  }

  void pose() {
    for (std::size_t i = 0; i < count_; ++i) {
      const auto constant = constantsOf(i);
      const auto own = stateOf(i);
      const V3<double> angle = vectorAt<double>(own, kAngle), speed = vectorAt<double>(own, kSpeed);
      const double* p = after_.data() + std::size_t{parent_[i]} * kRow;
      const auto vector = [&](int at) { return V3<double>{p[at], p[at + 1], p[at + 2]}; };
      const Pose<double> pose =
          posed(constant, own, Pose<double>{{p[0], p[1], p[2], p[3]}, vector(4), vector(8), vector(12)}, angle, speed);
      const double row[kRow] = {
          pose.turn.x,     pose.turn.y,     pose.turn.z,     pose.turn.w, pose.place.x, pose.place.y, pose.place.z, 0,
          pose.velocity.x, pose.velocity.y, pose.velocity.z, 0,           pose.spin.x,  pose.spin.y,  pose.spin.z,  0};
      std::copy(row, row + kRow, after_.data() + i * kRow);
      if (settings_.method == sim::TreeMethod::Coupled) {
        V3<double> spin = speed, velocity{0, 0, 0};
        if (parent_[i] < count_) {
          const auto above = stateOf(parent_[i]);
          const Turn<double> turn = turnAt<double>(constant, kRestTurn);
          const V3<double> o = vectorAt<double>(above, kSpin);
          spin = spin + turnedBack(turn, o);
          velocity = turnedBack(
              turn, vectorAt<double>(above, kVelocity) + crossOf(o, vectorAt<double>(constant, kRestOffset)));
        }
        putVector(own, kSpin, spin);
        putVector(own, kVelocity, velocity);
      } else if (settings_.method != sim::TreeMethod::Forces) {
        const double k = constant.get(kBending), t = constant.get(kTwist);
        for (std::uint32_t a = 0; a < 3; ++a) {
          const V3<double> u = vectorAt<double>(constant, kModes + 3 * a);
          own.put(kMode + a, u.x * k * angle.x + u.y * k * angle.y + u.z * t * angle.z);
          own.put(kModeSpeed + a, u.x * k * speed.x + u.y * k * speed.y + u.z * t * speed.z);
        }
      }
    }
    before_ = after_;
  }

  void step(const Air& air) {
    for (std::size_t i = 0; i < count_; ++i) {
      const glm::dvec3 u = air(placeOf(i, {0, 0, 0.5 * bodies_[i].length}));
      for (std::uint32_t k = 0; k < 3; ++k) {
        fieldsOf(air_.data(), 3, static_cast<std::uint32_t>(i)).put(k, u[static_cast<int>(k)]);
      }
    }
    sweep_(*this);
  }

  double elasticEnergy() const {
    double sum = 0;
    for (std::size_t i = 0; i < count_; ++i) sum += 0.5 * glm::dot(angle(i), bodies_[i].stiffness * angle(i));
    return sum;
  }

  /// Of the linear system that the method steps.
  double kineticEnergy() const {
    double sum = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (settings_.method == sim::TreeMethod::Coupled) {
        const sim::LinkBody& body = bodies_[i];
        const double r = 0.5 * body.length;
        const glm::dvec3 o = variable(i, kSpin), v = variable(i, kVelocity) + glm::dvec3(o.y * r, -o.x * r, 0);
        sum += 0.5 * (body.mass * glm::dot(v, v) + body.across * (o.x * o.x + o.y * o.y) + body.along * o.z * o.z +
                      floor_[i] * speed(i).z * speed(i).z);
      } else if (settings_.method != sim::TreeMethod::Forces) {
        for (std::uint32_t a = 0; a < 3; ++a) {
          const double rate = variable(i, kModeSpeed)[static_cast<int>(a)];
          sum += 0.5 * rate * rate / constantsOf(i).get(kSquares + a);
        }
      }
    }
    return sum;
  }

 private:
  class Sink final : public sim::ConstantSink {
   public:
    explicit Sink(ExactTree& tree) : tree_(tree) {}
    void put(std::size_t link, std::uint32_t first, std::span<const double> constants) override {
      const auto fields = fieldsOf(tree_.constants_.data(), tree_.constantFields_, static_cast<std::uint32_t>(link));
      for (std::uint32_t f = 0; f < constants.size() && first + f < tree_.constantFields_; ++f) {
        fields.put(first + f, constants[f]);
      }
    }
    void put(std::size_t, const sim::LinkInertia&) override {}

   private:
    ExactTree& tree_;
  };

  template <class Solver>
  void layOut() {
    constantFields_ = Solver::kConstants;
    stateFields_ = Solver::kVariables;
    sweep_ = [](ExactTree& tree) { tree.sweep<Solver>(); };
  }

  template <class Solver>
  void sweep() {
    before_.swap(after_);
    LinkSlots<double> slots;
    slots.link = link_.data();
    slots.parent = parent_.data();
    slots.base = base_.data();
    slots.constants = constants_.data();
    slots.state = state_.data();
    slots.air = air_.data();
    slots.sums = sums_.data();
    slots.moves = moves_.data();
    slots.before = before_.data();
    slots.after = after_.data();
    slots.constantFields = constantFields_;
    slots.stateFields = stateFields_;
    LinkStep<double> step;
    step.h = settings_.h;
    step.implicitness = settings_.implicitness;
    step.geometric = settings_.method == sim::TreeMethod::Literal ? 0 : 1;
    const LinkChildren children{begin_.data(), children_.data()};
    const auto n = static_cast<std::uint32_t>(count_);
    for (std::uint32_t s = n; s-- > 0;) slotUp<Solver>(slots, children, step, s);
    for (std::uint32_t s = 0; s < n; ++s) slotDown<Solver>(slots, step, s);
  }

  SlotFields<const double> constantsOf(std::size_t i) const {
    return fieldsOf(constants_.data(), constantFields_, static_cast<std::uint32_t>(i));
  }
  SlotFields<double> stateOf(std::size_t i) {
    return fieldsOf(state_.data(), stateFields_, static_cast<std::uint32_t>(i));
  }
  glm::dvec3 variable(std::size_t i, std::uint32_t first) const {
    const auto fields = fieldsOf(state_.data(), stateFields_, static_cast<std::uint32_t>(i));
    return {fields.get(first), fields.get(first + 1), fields.get(first + 2)};
  }

  sim::FactorSettings settings_;
  std::size_t count_;
  std::vector<sim::LinkBody> bodies_;
  std::vector<double> floor_;  ///< twist inertia on top, kg m2
  std::uint32_t constantFields_ = 0, stateFields_ = 0;
  std::vector<std::uint32_t> link_, parent_, base_, begin_, children_;
  std::vector<double> constants_, state_, air_, sums_, moves_, before_, after_;
  std::function<void(ExactTree&)> sweep_;
};

}  // namespace windfall::test
