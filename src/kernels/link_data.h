// A link as the solver stores it: constants, factors of the coupled system, motion. tree_dynamics.md, 1, 2 and 6.
#pragma once

#include <cstdint>

#include "kernels/link_state.h"
#include "kernels/math.h"

namespace windfall {

/// Constants of a link. "Joint frame": moves with the parent; at rest it is the link's own frame.
struct LinkShape {
  vec4 restRotation{0, 0, 0, 1};  ///< q0: link to parent at rest (a root: to world)
  vec3 restOffset{0};             ///< p0: joint in the parent's frame, m (a root: world position)
  std::int32_t parent = -1;       ///< global index, smaller than the own one
  vec3 stiffness{0};              ///< K: bending x, bending y, twist, N m/rad
  float halfLength = 0;           ///< m
  vec3 velocityTerm{0};           ///< (theta h + beta) K + theta h g: what multiplies the joint's speed, N m s
  float weight = 0;               ///< m |g|, N
  vec3 preStress{0};              ///< tau0: torque that the rest pose carries, joint frame, N m
  float woodDrag = 0;             ///< drag of the wood over speed across times speed, N s2/m2
  float leafDrag = 0;             ///< the same of the leaves at low speed, N s2/m2
  float dragSlope = 0;            ///< c: dF/dv at the level of the mean wind, N s/m
  mat3 restMatrix{1};             ///< q0 as a matrix: five such turns a step are cheaper so
  float spare = 0;
};
static_assert(sizeof(LinkShape) == 128);

/// What the load-time factorisation keeps of a link (6.2).
struct LinkFactor {
  float inverse[6];    ///< Di, symmetric: xx xy xz yy yz zz
  float transfer[18];  ///< W: rows of W_top, then of W_bot, 3 columns
};
static_assert(sizeof(LinkFactor) == 96);

/// State of a joint, and what the last pass left.
struct LinkMotion {
  vec3 angle{0};            ///< theta: rotation vector about the rest pose, joint frame, rad
  vec3 speed{0};            ///< omega: its rate, rad/s
  vec3 angularVelocity{0};  ///< o: of the linear system, rest frame of the link, rad/s
  vec3 velocity{0};         ///< v: of the joint, the same frame, m/s
  vec3 answer{0};           ///< u of the upward pass, rad/s2
};
static_assert(sizeof(LinkMotion) == 60);

/// What a link has summed up from its outboard side.
struct LinkLoad {
  vec3 force{0};       ///< world, N
  vec3 torque{0};      ///< world, about the joint, N m
  vec3 biasTorque{0};  ///< pn: own rest frame, N m
  vec3 biasForce{0};   ///< pf: own rest frame, N
};
static_assert(sizeof(LinkLoad) == 48);

/// Everything a pass over links needs; pointers of the device that runs it.
struct LinksView {
  const LinkShape* shape = nullptr;
  const LinkFactor* factor = nullptr;
  LinkMotion* motion = nullptr;
  LinkLoad* load = nullptr;
  const LinkState* before = nullptr;  ///< poses at the start of the step
  LinkState* after = nullptr;         ///< poses at its end
};

/// Constants of a step.
struct LinkStepParameters {
  float h = 1.f / 60;         ///< s
  float implicitness = 0.6f;  ///< theta of the note's 6.1, 0.5..1
  float saturation = 0.8f;    ///< theta_max, rad
};

}  // namespace windfall
