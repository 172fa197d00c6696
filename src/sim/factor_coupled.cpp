// The factorisation of the coupled system at rest (tree_dynamics.md, 6.2).
#include <algorithm>
#include <array>
#include <numbers>

#include "kernels/link_coupled.h"
#include "sim/bent_drag.h"
#include "sim/factor_parts.h"

namespace windfall::sim {

namespace {

using glm::dmat3;
using glm::dvec3;

/// Matrix of the cross product v x.
dmat3 skew(const dvec3& v) { return {0, v.z, -v.y, -v.z, 0, v.x, v.y, -v.x, 0}; }

class CoupledFactors final : public FactorPass {
 public:
  explicit CoupledFactors(const Tree& tree)
      : bent_(tree), walk_(tree.links), open_(walk_.depth()), links_(tree.links.size()) {}

  void begin(const FactorInput& input) override {
    input_ = input;
    const FactorSettings& settings = input.settings;
    if (settings.bentDrag) bent_.begin(input);
    beta_ = input.frequency > 0 ? 2 * settings.dampingRatio / (2 * std::numbers::pi * input.frequency) : 0;
    vh_ = settings.implicitness * settings.h;
    numerical_ = settings.compensate ? (2 * settings.implicitness - 1) * settings.h : 0;
    walk_.begin(links_);
  }

  bool advance(std::size_t& visits, ConstantSink& sink) override {
    if (input_.settings.bentDrag && !bent_.advance(visits)) return false;
    sink_ = &sink;
    walk_.advance(input_.tree->links, visits, *this);
    return walk_.isDone();
  }

  std::size_t visits() const override { return bent_.visits() + 2 * links_; }
  std::size_t bytes() const override { return bent_.bytes() + open_.size() * sizeof(Open); }

  void enter(std::size_t link, std::size_t depth) {
    open_[depth] = {};
    open_[depth].body = input_.body(link);
  }

  void leave(std::size_t link, std::size_t depth);

 private:
  /// An open link with what it carries: loads and inertia as one rigid body, and its articulated inertia in its own
  /// rest frame, [J H; H^T M].
  struct Open {
    LinkBody body;
    RestLoads loads;
    Composite composite;
    dmat3 inertia{0}, coupling{0}, mass{0};
  };

  FactorInput input_;
  BentDrag bent_;
  BranchWalk walk_;
  std::vector<Open> open_;
  std::size_t links_;
  double beta_ = 0, vh_ = 0, numerical_ = 0;
  ConstantSink* sink_ = nullptr;
};

void CoupledFactors::leave(std::size_t link, std::size_t depth) {
  Open& open = open_[depth];
  Open* parent = depth > 0 ? &open_[depth - 1] : nullptr;
  const FactorSettings& settings = input_.settings;
  const LinkBody& body = open.body;
  const dvec3 d = parent != nullptr ? body.joint - parent->body.joint : dvec3(0);
  open.loads.add(body, settings);
  open.composite.add(body);
  if (parent != nullptr) {
    parent->loads.add(open.loads, d);
    parent->composite.add(open.composite, d);
  }

  // Damping by mass acts as a drag of the whole link.
  const double slope = dragSlope(body, settings) + body.rayleighAlpha * body.mass;
  const double heavy = body.mass + vh_ * slope;
  const dmat3 arm = skew(dvec3(0, 0, 0.5 * body.length));
  dmat3 &j = open.inertia, &h = open.coupling, &m = open.mass;
  j += dmat3(body.across, 0, 0, 0, body.across, 0, 0, 0, body.along) + heavy * glm::transpose(arm) * arm;
  h += heavy * arm;
  m += dmat3(heavy);

  const double ownBeta = std::max(0.0, beta_ * body.dampingScale + body.rayleighBeta - numerical_);
  const double geometric = open.loads.geometric(), bent = settings.bentDrag ? bent_[link] : 0;
  dvec3 diagonal = body.stiffness * (vh_ * ownBeta + vh_ * vh_) + dvec3(geometric * vh_ * vh_);
  const double floor = settings.twistFloor ? twistFloor(body, open.composite) : 0;
  diagonal.z += floor;
  diagonal.z += vh_ * bent;
  const dmat3 inverse = glm::inverse(j + dmat3(diagonal.x, 0, 0, 0, diagonal.y, 0, 0, 0, diagonal.z));
  const dmat3 jd = j * inverse, hd = glm::transpose(h) * inverse;

  const RestJoint joint(body, parent != nullptr ? &parent->body : nullptr);
  const dmat3 r = glm::mat3_cast(joint.turn), s = skew(joint.offset);
  const dmat3 bottom = r * hd, top = r * jd + s * bottom;
  if (parent != nullptr) {
    const auto turned = [&](const dmat3& x) { return r * x * glm::transpose(r); };
    const dmat3 ja = turned(j - jd * j), ha = turned(h - jd * h), ma = turned(m - hd * h);
    const dmat3 sha = s * glm::transpose(ha);
    parent->inertia += ja + sha + glm::transpose(sha) - s * ma * s;
    parent->coupling += ha + s * ma;
    parent->mass += ma;
  }

  std::array<double, kCoupledConstants> constants{};
  commonConstants(body, joint, settings, glm::transpose(body.axes) * open.loads.torque, constants);
  constants[kDragSlope] = slope;
  constants[kBendingSpeed] = body.stiffness.x * (vh_ + ownBeta) + geometric * vh_;
  constants[kTwistSpeed] = body.stiffness.z * (vh_ + ownBeta) + geometric * vh_ + bent;
  std::size_t k = kInverse;
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column) constants[k++] = 0.5 * (inverse[column][row] + inverse[row][column]);
  }
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      constants[kTransfer + static_cast<std::size_t>(row * 3 + column)] = top[column][row];
      constants[kTransfer + 9 + static_cast<std::size_t>(row * 3 + column)] = bottom[column][row];
    }
  }
  sink_->put(link, 0, constants);
  const auto narrow = [](double value) { return static_cast<float>(value); };
  sink_->put(link, {narrow(body.mass), narrow(body.across), narrow(body.along), narrow(floor)});
}

}  // namespace

std::unique_ptr<FactorPass> makeCoupledFactors(const Tree& tree) { return std::make_unique<CoupledFactors>(tree); }

}  // namespace windfall::sim
