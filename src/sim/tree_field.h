// All trees of a scene in motion on the CPU: solver C of tree_dynamics.md.
#pragma once

#include <span>
#include <vector>

#include "kernels/link_data.h"
#include "kernels/wind.h"
#include "sim/engine.h"
#include "sim/factor.h"
#include "sim/treelets.h"

namespace windfall::sim {

/// The links of all trees, one after the other. The result of a step is the same for any number of threads.
class TreeField {
 public:
  /// The trees have no problem (problemOf).
  TreeField(std::vector<TreeInstance> trees, const FactorSettings& settings, int threads,
            std::uint32_t treeletSize = kTreeletSize);
  static constexpr std::uint32_t kTreeletSize = 512;  ///< links that one thread takes as a whole, at most

  /// Takes over new settings, fallen leaves (m2 a link) or trees of the same links; the motion goes on.
  void factorise(const FactorSettings& settings);
  void setLostArea(std::span<const float> area);
  std::span<const float> lostArea() const { return lostArea_; }
  void setTree(std::size_t instance, std::shared_ptr<const Tree> tree);
  const FactorSettings& settings() const { return settings_; }
  double frequency(std::size_t instance) const { return frequencies_[instance]; }  ///< first frequency, Hz

  void reset();
  /// One step of settings().h in the given wind.
  void step(const WindView& wind);

  /// One step that was made elsewhere from the current state: takes the new state over, gives the buffers of the old
  /// one.
  void takeStep(std::vector<LinkMotion>& motion, std::vector<LinkState>& now);
  /// Counts changes of the constants, and changes of the state that were no step.
  std::uint64_t revision() const { return revision_; }
  const Partition& cut() const { return partition_; }

  std::size_t size() const { return motion_.size(); }
  std::span<const std::uint32_t> firstLinks() const { return firstLinks_; }  ///< of each tree
  const std::vector<TreeInstance>& trees() const { return trees_; }
  std::span<const LinkState> previous() const { return before_; }
  std::span<const LinkState> current() const { return after_; }
  std::span<const LinkShape> shapes() const { return shapes_; }
  std::span<const LinkFactor> factors() const { return factors_; }
  std::span<LinkMotion> motion() { return motion_; }
  std::span<const LinkMotion> motion() const { return motion_; }
  /// After the motion was written from outside: poses of the last two steps are given.
  void setPoses(std::span<const LinkState> before, std::span<const LinkState> after);
  /// Poses the links by their joint angles, as both last steps.
  void pose();

  double kineticEnergy() const;  ///< J, of the linear system
  double elasticEnergy() const;  ///< J
  float largestAngle() const;    ///< rad

 private:
  LinksView view();
  void factoriseTree(std::size_t instance);
  void sweep(const LinksView& links, const WindView& wind);

  std::vector<TreeInstance> trees_;
  FactorSettings settings_;
  int threads_;
  std::vector<std::uint32_t> firstLinks_;
  Partition partition_;
  std::vector<LinkShape> shapes_;
  std::vector<LinkFactor> factors_;
  std::vector<LinkMotion> motion_;
  std::vector<LinkLoad> loads_, exports_;
  std::vector<LinkState> before_, after_;
  std::vector<LinkInertia> inertia_;
  std::uint64_t revision_ = 0;
  std::vector<double> frequencies_;  ///< of each tree as it was set, Hz
  std::vector<float> lostArea_;      ///< of each link's leaves, as factorised, m2
};

}  // namespace windfall::sim
