// The modes of the analytic solver's joints (tree_dynamics.md, 5.2, 5.6 to 5.8).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "kernels/link_modal.h"
#include "sim/axis_modes.h"
#include "sim/bent_drag.h"
#include "sim/factor_parts.h"
#include "sim/symmetric_eigen.h"

namespace windfall::sim {

namespace {

using glm::dmat3;
using glm::dvec3;

constexpr std::uint32_t kNone = 0xffffffffu;

/// Half the structural damping of a mode, 1/s. It follows the stiffness as in the coupled solver and in wood, so that
/// twigs have more of it than the trunk: with one ratio for every joint (2.3) they ring with every tremor of what they
/// grow from, and flutter in storms (tests V7, V8). The published form has one ratio.
double structuralDamping(double lambda, const FactorInput& input) {
  const double ratio = input.settings.dampingRatio;
  if (input.settings.method == TreeMethod::Literal || !(input.frequency > 0)) return ratio * std::sqrt(lambda);
  return 0.5 * lambda * 2 * ratio / (2 * std::numbers::pi * input.frequency);
}

/// Constants of a joint beside the common ones; without a mode the joint swings by itself.
void modalConstants(const LinkBody& body, const Composite& composite, const Composite& drag, const AxisMode* mode,
                    double bent, const FactorInput& input, std::span<double> constants) {
  const auto at = [&](std::uint32_t field) -> double& { return constants[field - kCommonConstants]; };
  dmat3 inertia = glm::transpose(body.axes) * composite.inertia * body.axes;
  if (input.settings.twistFloor) inertia[2][2] += twistFloor(body, composite);
  // By itself every joint would swing too fast, the more so the finer the axis is cut; as part of the axis' mode it
  // has the inertia k / Omega^2.
  double air = 0;
  if (mode != nullptr && mode->square > 0) {
    const double bending = inertia[0][0] * inertia[1][1] - inertia[1][0] * inertia[0][1];
    inertia *= body.stiffness.x / (mode->square * std::sqrt(std::max(bending, 1e-300)));
    air = mode->airRate;
  } else {
    const dmat3 &c = drag.inertia, &m = composite.inertia;
    air = (c[0][0] + c[1][1] + c[2][2]) / (m[0][0] + m[1][1] + m[2][2]);
  }
  const dvec3 s = 1.0 / glm::sqrt(body.stiffness);
  dmat3 scaled = inertia;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) scaled[column][row] *= s[column] * s[row];
  }
  dvec3 mu;
  dmat3 vectors;
  symmetricEigen(scaled, mu, vectors);
  for (std::uint32_t a = 0; a < 3; ++a) {
    const int mode3 = static_cast<int>(a);
    const double lambda = 1 / std::max(mu[mode3], 1e-30);
    for (std::uint32_t row = 0; row < 3; ++row) {
      at(kModes + 3 * a + row) = s[static_cast<int>(row)] * vectors[mode3][static_cast<int>(row)];
    }
    at(kSquares + a) = lambda;
    // Of a mode u the damping is u D u over u I u = 1 / lambda.
    const double twist = s.z * vectors[mode3][2], sweep = bent * twist * twist * lambda;
    at(kDampings + a) = body.dampingScale * structuralDamping(lambda, input) +
                        0.5 * (air + sweep + body.rayleighAlpha + body.rayleighBeta * lambda);
  }
  const auto put = [&](std::uint32_t moment, std::uint32_t matrix, const Composite& c) {
    const dvec3 m = glm::transpose(body.axes) * c.moment;
    const dmat3 local = glm::transpose(body.axes) * c.inertia * body.axes;
    std::uint32_t k = matrix;
    for (int row = 0; row < 3; ++row) {
      at(moment + static_cast<std::uint32_t>(row)) = m[row];
      for (int column = row; column < 3; ++column) at(k++) = local[column][row];
    }
  };
  put(kMoment, kInertia6, composite);
  put(kDragMoment, kDragInertia, drag);
}

class ModalFactors final : public FactorPass {
 public:
  ModalFactors(const Tree& tree, bool calibrated)
      : bent_(calibrated ? tree : Tree()),
        walk_(tree.links),
        open_(walk_.depth()),
        links_(tree.links.size()),
        calibrated_(calibrated),
        modes_(calibrated ? walk_.depth() : 0) {
    if (!calibrated) return;
    carried_.resize(links_);
    next_.resize(links_);
    axisLinks_.reserve(walk_.depth());
    axis_.bodies.reserve(walk_.depth());
    for (auto* composites : {&axis_.composites, &axis_.drags}) composites->reserve(walk_.depth());
  }

  void begin(const FactorInput& input) override {
    input_ = input;
    if (isBent()) bent_.begin(input);
    if (calibrated_) findAxes();
    walk_.begin(links_);
  }
  bool advance(std::size_t& visits, ConstantSink& sink) override {
    if (isBent() && !bent_.advance(visits)) return false;
    sink_ = &sink;
    walk_.advance(input_.tree->links, visits, *this);
    return walk_.isDone();
  }
  std::size_t visits() const override { return bent_.visits() + 2 * links_; }
  std::size_t bytes() const override {
    return bent_.bytes() + open_.size() * (sizeof(Open) + 2 * sizeof(Composite) + sizeof(LinkBody)) +
           carried_.size() * sizeof(Carried) + next_.size() * sizeof(next_[0]);
  }

  void enter(std::size_t link, std::size_t depth) {
    open_[depth] = {};
    open_[depth].body = input_.body(link);
  }

  void leave(std::size_t link, std::size_t depth) {
    Open& open = open_[depth];
    const LinkBody& body = open.body;
    open.loads.add(body, input_.settings);
    open.carried.mass.add(body);
    // The drag's slope in the place of mass.
    LinkBody drag = body;
    drag.mass = dragSlope(body, input_.settings);
    drag.across = drag.along = 0;
    open.carried.drag.add(drag);
    const LinkBody* above = nullptr;
    if (depth > 0) {
      Open& parent = open_[depth - 1];
      const dvec3 d = body.joint - parent.body.joint;
      parent.loads.add(open.loads, d);
      parent.carried.mass.add(open.carried.mass, d);
      parent.carried.drag.add(open.carried.drag, d);
      above = &parent.body;
    }
    std::array<double, kCommonConstants> common{};
    commonConstants(body, RestJoint(body, above), input_.settings, glm::transpose(body.axes) * open.loads.torque,
                    common);
    sink_->put(link, 0, common);
    if (!calibrated_) {
      putModes(link, body, open.carried.mass, open.carried.drag, nullptr);
      return;
    }
    carried_[link] = open.carried;
    const bool begins = !body.continues || next_[static_cast<std::size_t>(body.parent)] != link;
    if (begins) finishAxis(link);
  }

 private:
  struct Carried {
    Composite mass, drag;
  };
  struct Open {
    LinkBody body;
    RestLoads loads;
    Carried carried;
  };
  /// The links of one axis, from its base to its tip.
  struct Gathered {
    std::vector<LinkBody> bodies;
    std::vector<Composite> composites, drags;
  };

  bool isBent() const { return calibrated_ && input_.settings.bentDrag; }

  /// An axis forks where two children continue it: the first goes on, the others begin anew.
  void findAxes() {
    const std::vector<Link>& links = input_.tree->links;
    std::fill(next_.begin(), next_.end(), kNone);
    for (std::size_t i = 0; i < links_; ++i) {
      if (links[i].parent < 0) continue;
      const auto p = static_cast<std::size_t>(links[i].parent);
      if (links[p].chain == links[i].chain && next_[p] == kNone) next_[p] = static_cast<std::uint32_t>(i);
    }
  }

  void finishAxis(std::size_t base) {
    axisLinks_.clear();
    axis_.bodies.clear();
    axis_.composites.clear();
    axis_.drags.clear();
    for (std::size_t k = base; k != kNone; k = next_[k]) {
      axisLinks_.push_back(k);
      axis_.bodies.push_back(input_.body(k));
      axis_.composites.push_back(carried_[k].mass);
      axis_.drags.push_back(carried_[k].drag);
    }
    const AxisMode mode = modes_.modeOf({axis_.bodies, axis_.composites, axis_.drags});
    for (std::size_t k = 0; k < axisLinks_.size(); ++k) {
      putModes(axisLinks_[k], axis_.bodies[k], axis_.composites[k], axis_.drags[k], &mode);
    }
  }

  void putModes(std::size_t link, const LinkBody& body, const Composite& composite, const Composite& drag,
                const AxisMode* mode) {
    std::array<double, std::uint32_t{kAxisConstants} - kCommonConstants> constants{};
    modalConstants(body, composite, drag, mode, isBent() ? bent_[link] : 0, input_, constants);
    sink_->put(link, kCommonConstants, constants);
  }

  FactorInput input_;
  BentDrag bent_;
  BranchWalk walk_;
  std::vector<Open> open_;
  std::size_t links_;
  bool calibrated_;
  std::vector<Carried> carried_;     ///< by each link
  std::vector<std::uint32_t> next_;  ///< link that continues each link's axis
  std::vector<std::size_t> axisLinks_;
  Gathered axis_;
  AxisModes modes_;
  ConstantSink* sink_ = nullptr;
};

}  // namespace

std::unique_ptr<FactorPass> makeModalFactors(const Tree& tree, bool calibrated) {
  return std::make_unique<ModalFactors>(tree, calibrated);
}

}  // namespace windfall::sim
