// Air that brakes the twist of branches which the mean wind has bent.
#pragma once

#include <vector>

#include "sim/branch_walk.h"
#include "sim/factor.h"

namespace windfall::sim {

/// What the drag of everything outboard adds to each joint's damping of twist, since it is bent by gusts of
/// twice the mean wind: a bent twig that twists sweeps through the air, while the drag's matrix of the straight rest
/// pose (tree_dynamics.md, 6.1) sees it turn on the spot. Without it twigs flutter in a steady wind and twist past 3
/// rad in storms (tests V6, V7). 0 in calm air. Reckoned a piece at a time; memory is taken when it is made.
class BentDrag {
 public:
  explicit BentDrag(const Tree& tree);
  void begin(const FactorInput& input);
  /// Goes on for at most `visits` visits, which it takes off. True when all is done.
  bool advance(std::size_t& visits);
  std::size_t visits() const { return 2 * angles_.size() * (kRounds + 1); }
  std::size_t bytes() const;
  /// Of a joint, N m s.
  double operator[](std::size_t link) const { return isCalm_ ? 0 : drag_[link]; }

  void enter(std::size_t link, std::size_t depth);
  void leave(std::size_t link, std::size_t depth);

 private:
  static constexpr int kRounds = 3;  ///< towards the balance of springs and wind

  /// An open link: at rest; as it leans, with the slope of its drag in the place of mass; loads of what it carries.
  struct Open {
    LinkBody body, leaning;
    glm::dmat3 frame{1};  ///< of the joint
    glm::dvec3 wind{0}, force{0}, torque{0};
    Composite drag;
  };

  BranchWalk walk_;
  FactorInput input_;  ///< in gusts
  bool isCalm_ = true;
  int round_ = 0;
  std::vector<Open> open_;
  std::vector<glm::dvec3> angles_;
  std::vector<double> drag_;
};

}  // namespace windfall::sim
