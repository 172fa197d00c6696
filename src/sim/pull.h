// A hand on a branch.
#pragma once

#include <cstddef>

#include "kernels/wind.h"
#include "sim/tree.h"

namespace windfall::sim {

class TreeField;

/// A link that is held and where it is wanted.
struct Pull {
  std::size_t link = 0;  ///< of all instances, in order
  vec3 grab{0};          ///< m, the place that is held: rest space of its tree
  vec3 target{0};        ///< m, where it is wanted: world
  bool operator==(const Pull&) const = default;
};

/// The force of a hand: what bends the branch at rest to the target by the compliance of the joints that carry it, and
/// a little more while the branch is not there. The hand moves with a delay of some hundredths of a second, so that a
/// fast pointer is no blow. Nothing is stiffer than the branch itself, so it is stable at any step.
class PullForce {
 public:
  /// Takes hold of another place, or moves the hand. `placement` is that of the link's tree, `link` its shape at rest.
  void hold(const Pull& pull, const Link& link, const Placement& placement, const TreeField& trees);
  void release() { held_ = false; }
  bool isHeld() const { return held_; }
  const Pull& pull() const { return pull_; }
  /// The load of the next step of h seconds.
  LinkPull next(const TreeField& trees, float h);

 private:
  vec3 placeNow(const TreeField& trees) const;

  bool held_ = false;
  Pull pull_;
  vec3 local_{0};        ///< of the grabbed place, link frame
  vec3 rest_{0};         ///< of the grabbed place, world
  vec3 hand_{0};         ///< where the hand is by now
  float stiffness_ = 0;  ///< N/m
};

}  // namespace windfall::sim
