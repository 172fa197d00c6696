// The joints of the forces method, repaired (tree_dynamics.md, 7).
#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/link_forces.h"
#include "sim/factor_parts.h"

namespace windfall::sim {

namespace {

class ForcesFactors final : public FactorPass {
 public:
  explicit ForcesFactors(const Tree& tree) : walk_(tree.links), open_(walk_.depth()), links_(tree.links.size()) {}

  void begin(const FactorInput& input) override {
    input_ = input;
    walk_.begin(links_);
  }
  bool advance(std::size_t& visits, ConstantSink& sink) override {
    sink_ = &sink;
    walk_.advance(input_.tree->links, visits, *this);
    return walk_.isDone();
  }
  std::size_t visits() const override { return 2 * links_; }
  std::size_t bytes() const override { return open_.size() * sizeof(LinkBody); }

  void enter(std::size_t link, std::size_t depth) { open_[depth] = input_.body(link); }

  void leave(std::size_t link, std::size_t depth) {
    const FactorSettings& settings = input_.settings;
    const LinkBody& body = open_[depth];
    const LinkBody* parent = depth > 0 ? &open_[depth - 1] : nullptr;
    std::array<double, kForcesConstants> constants{};
    // Weight and the torque that carries it are in balance at rest; this method knows neither.
    commonConstants(body, RestJoint(body, parent), settings, glm::dvec3(0), constants);
    const double across = body.across + 0.25 * body.mass * body.length * body.length;
    const double along = std::max(body.along, 0.3 * across);
    const auto structural = [&](double k, double inertia) {
      return body.dampingScale * 2 * settings.dampingRatio * std::sqrt(k * inertia) + body.rayleighBeta * k +
             body.rayleighAlpha * inertia;
    };
    const double air = dragSlope(body, settings) * body.length * body.length / 3;
    constants[kInertia] = across;
    constants[kTwistInertia] = along;
    constants[kLinearDamping] = structural(body.stiffness.x, across) + air;
    constants[kForcesTwistDamping] = structural(body.stiffness.z, along);
    // A cylinder that sweeps about its end: the drag's torque is 0.5 rho d l^4 / 4 w |w|.
    constants[kQuadraticDamping] = 0.25 * body.woodDrag * std::pow(body.length, 3);
    const double thickness = parent != nullptr ? parent->radius : body.radius;
    constants[kPropagation] = std::clamp(body.propagation * body.radius / thickness, 0.0, 0.8);
    sink_->put(link, 0, constants);
  }

 private:
  FactorInput input_;
  BranchWalk walk_;
  std::vector<LinkBody> open_;
  std::size_t links_;
  ConstantSink* sink_ = nullptr;
};

}  // namespace

std::unique_ptr<FactorPass> makeForcesFactors(const Tree& tree) { return std::make_unique<ForcesFactors>(tree); }

}  // namespace windfall::sim
