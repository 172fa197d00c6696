// All trees of a scene in motion on the CPU (tree_dynamics.md).
#pragma once

#include <span>
#include <vector>

#include "kernels/link_loops.h"
#include "sim/aligned.h"
#include "sim/engine.h"
#include "sim/factor.h"
#include "sim/treelets.h"

namespace windfall::sim {

/// A force from outside on a link, in addition to wind and weight.
struct LinkForce {
  std::uint32_t link = 0xffffffffu;  ///< index over the whole field; none
  vec3 force{0};                     ///< world, N
  vec3 arm{0};                       ///< where it pulls, from the joint, world axes, m
};

/// A link's constants as the solvers see them.
struct LinkShape {
  float halfLength = 0;  ///< m
  float weight = 0;      ///< N
  float woodDrag = 0, leafDrag = 0;
  vec4 restRotation{0, 0, 0, 1};
  vec3 restOffset{0};
  vec3 stiffness{0};  ///< N m/rad
  vec3 preStress{0};  ///< N m
  std::int32_t parent = -1;
};

/// Whether the fictitious torques of 5.9 are asked for and belong to the method.
inline bool usesAxes(const FactorSettings& settings) {
  return settings.method == TreeMethod::Analytic && settings.axisMotion;
}

/// Whether joints are oscillators of their own modes.
inline bool isModal(TreeMethod method) { return method == TreeMethod::Analytic || method == TreeMethod::Literal; }

/// How the links are cut; see Arrangement.
struct FieldCut {
  std::uint32_t treelet = 512;  ///< links of a subtree that is not cut further, at most
  std::uint32_t part = 1024;    ///< links that one thread takes as a whole, about
  std::uint32_t width = 16;     ///< slots of a round
};

/// The links of all trees, one after the other. The result of a step is the same for any number of threads.
class TreeField {
 public:
  /// The trees have no problem (problemOf).
  TreeField(std::vector<TreeInstance> trees, const FactorSettings& settings, int threads, const FieldCut& cut = {});

  /// Takes over new settings, fallen leaves (m2 a link) or trees of the same links at once; the motion goes on.
  void factorise(const FactorSettings& settings);
  void setLostArea(std::span<const float> area);
  std::span<const float> lostArea() const { return lostArea_; }
  void setTree(std::size_t instance, std::shared_ptr<const Tree> tree);
  const FactorSettings& settings() const { return settings_; }

  /// Another wind, or leaves that have fallen by now: the constants are made anew beside the steps to come, a piece in
  /// each, and taken all at once at the end of at most kFactorSteps; the count depends on the trees alone. While that
  /// goes on another call does nothing.
  void renew(const FactorSettings& settings, std::span<const float> lostArea);
  bool isRenewing() const { return renewing_; }
  static constexpr std::size_t kFactorSteps = 30;
  /// The next piece by itself; `sampleAir` makes it too.
  void renewOn();

  /// What of that a saved state keeps.
  struct Renewal {
    double windSpeed = 0, direction[3] = {1, 0, 0};          ///< of the constants in use
    double nextWindSpeed = 0, nextDirection[3] = {1, 0, 0};  ///< of those being made
    std::int64_t pieces = -1;                                ///< made of them; -1: none are
  };
  Renewal renewal() const;
  std::span<const float> nextLostArea() const { return renewing_ ? nextLostArea_ : lostArea_; }
  /// Goes on from there; the other settings stay.
  void resume(const Renewal& saved, std::span<const float> lostArea, std::span<const float> nextLostArea);
  double frequency(std::size_t instance) const { return frequencies_[instance]; }  ///< first frequency, Hz

  void reset();
  /// Forces for the next step alone.
  void setForces(std::span<const LinkForce> forces) { forces_ = forces; }
  /// A hand on a link, for the next step alone.
  void follow(const LinkPull& pull);
  /// The air around the links in their current pose, and the hand: the first half of a step.
  void sampleAir(const WindView& wind);
  /// The second half: one step of settings().h in the sampled air.
  void solve();
  void step(const WindView& wind) {
    sampleAir(wind);
    solve();
  }

  std::size_t size() const { return slots_.links; }
  std::span<const std::uint32_t> firstLinks() const { return firstLinks_; }  ///< of each tree
  const std::vector<TreeInstance>& trees() const { return trees_; }
  const Arrangement& slots() const { return slots_; }
  std::span<const LinkState> previous() const { return std::span(before_).first(size()); }
  std::span<const LinkState> current() const { return std::span(after_).first(size()); }
  LinkShape shape(std::size_t link) const;

  vec3 angle(std::size_t link) const { return variable(link, kAngle); }  ///< theta, rad
  vec3 speed(std::size_t link) const { return variable(link, kSpeed); }  ///< rad/s
  /// Sets a joint; `pose` must follow.
  void setJoint(std::size_t link, const vec3& angle, const vec3& speed = vec3(0));
  /// Poses the links by their joints, as both last steps, and brings the solver's own state in line.
  void pose();

  /// The solver's state as numbers, link by link, whatever the cut; and back with the poses of the last two steps.
  /// Equal numbers go on with equal bits.
  std::vector<float> state() const;
  void setState(std::span<const float> state, std::span<const LinkState> before, std::span<const LinkState> after);

  double kineticEnergy() const;  ///< J, of the linear system
  double elasticEnergy() const;  ///< J
  float largestAngle() const;    ///< rad
  /// Bytes of all arrays, those from which constants are made anew among them.
  std::size_t bytes() const;

  /// What a device needs to do the step in the place of `solve`. `outside`: the forces as rows of sums; empty where
  /// there are none.
  std::span<const float> outside();
  LinkSlots<float> view();
  std::span<const std::int32_t> parents() const { return parents_; }
  std::span<const std::uint32_t> bases() const { return bases_; }  ///< row of each slot's base (LinkSlots)
  std::span<const float> constants() const { return constants_; }
  std::span<const float> slotState() const { return state_; }
  std::span<const LinkState> rows() const {
    return after_;
  }  ///< current poses, with those of the ground and spare ones
  LinkStep<float> stepParameters() const;
  std::uint32_t sumRow() const { return sumRow_; }
  /// Counts changes of the constants, and changes of the state that were no step.
  std::uint64_t revision() const { return revision_; }
  /// One step that was made elsewhere from the current state: takes the new state over, gives the buffers of the old.
  void takeStep(AlignedVector<float>& state, AlignedVector<LinkState>& now);

 private:
  class Sink;
  void initialise(AlignedVector<float>& constants);
  FactorInput inputOf(std::size_t instance, const FactorSettings& settings, std::span<const float> lostArea) const;
  void factoriseTree(std::size_t instance);
  void beginRenewal();
  bool renewOn(std::size_t instance);
  void takeFactors();
  void toModes(std::size_t link);
  void findBases();
  void addForces();
  void addForce(const LinkForce& force);
  void crossTop(const LinkSlots<float>& view, const LinkStep<float>& step);
  vec3 variable(std::size_t link, std::uint32_t first) const;
  float constant(std::size_t link, std::uint32_t field) const;

  std::vector<TreeInstance> trees_;
  FactorSettings settings_;
  int threads_;
  std::vector<std::uint32_t> firstLinks_;
  std::vector<std::int32_t> parents_;
  Arrangement slots_;
  std::vector<std::uint32_t> bases_;
  std::uint32_t constantFields_ = 0, stateFields_ = 0, sumRow_ = 0;
  AlignedVector<float> constants_, state_, air_, sums_, moves_;
  AlignedVector<LinkState> before_, after_;
  std::vector<LinkInertia> inertia_;
  std::vector<std::unique_ptr<FactorPass>> factors_;  ///< of each tree
  std::span<const LinkForce> forces_;
  LinkForce pull_;
  bool forced_ = false;  ///< sums_ holds loads from outside
  std::uint64_t revision_ = 0;
  std::vector<double> frequencies_;  ///< of each tree as it was set, Hz
  std::vector<float> lostArea_;      ///< of each link's leaves, as factorised, m2

  // Constants that are being made.
  bool renewing_ = false;
  std::int64_t pieces_ = 0;  ///< made of them
  std::size_t pieceSteps_ = 1;
  FactorSettings nextSettings_;
  std::vector<float> nextLostArea_;
  AlignedVector<float> nextConstants_;
  std::vector<LinkInertia> nextInertia_;
  std::vector<char> made_;  ///< whether each tree's are
};

}  // namespace windfall::sim
