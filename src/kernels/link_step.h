// One step of the prefactored, two-way coupled tree solver (tree_dynamics.md, 6.2), link by link: forces and the upward
// pass in `linkUp`, the downward pass with the new pose in `linkDown`.
#pragma once

#include <cmath>

#include "kernels/link_data.h"
#include "kernels/rotation.h"
#include "kernels/wind.h"

namespace windfall {

/// m/s at which leaves turn out of the wind (2.4).
inline constexpr float kReconfigurationSpeed = 5.0f;

WINDFALL_HD vec3 turn(const mat3& m, const vec3& v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }
WINDFALL_HD vec3 turnBack(const mat3& m, const vec3& v) {
  return {m[0].x * v.x + m[0].y * v.y + m[0].z * v.z, m[1].x * v.x + m[1].y * v.y + m[1].z * v.z,
          m[2].x * v.x + m[2].y * v.y + m[2].z * v.z};
}

/// Drag of wood and leaves in the air velocity u, N: F = C(u) u. The branch's own velocity stays out; its part is in
/// the linear system (5.8).
WINDFALL_HD vec3 linkDrag(const LinkShape& shape, const vec3& along, const vec3& u) {
  const float square = glm::dot(u, u);
  const float inline_ = glm::dot(u, along);
  const float acrossSquare = square - inline_ * inline_;
  const float across = std::sqrt(acrossSquare > 0 ? acrossSquare : 0);
  const float leaves = std::sqrt(square / (1 + square * (1 / (kReconfigurationSpeed * kReconfigurationSpeed))));
  return u * (shape.woodDrag * across + shape.leafDrag * leaves);
}

/// The link's own loads at the start of a step: wind, weight, and the linear drag of its own motion.
WINDFALL_HD void linkForces(const LinksView& links, const WindView& wind, std::uint32_t i) {
  const LinkShape& shape = links.shape[i];
  const LinkState& state = links.before[i];
  const LinkMotion& motion = links.motion[i];
  const vec3 along = rotate(state.rotation, vec3(0, 0, 1));
  const vec3 arm = along * shape.halfLength;
  vec3 force = linkDrag(shape, along, windAt(wind, state.position + arm));
  force.y -= shape.weight;
  LinkLoad& load = links.load[i];
  load.force = force;
  load.torque = glm::cross(arm, force);
  if (wind.pull.link == i) {
    load.force += wind.pull.force;
    load.torque += glm::cross(wind.pull.arm, wind.pull.force);
  }
  // Velocity of the centre of mass, rest frame: v + o x (0, 0, l/2).
  const float r = shape.halfLength;
  load.biasForce =
      shape.dragSlope * (motion.velocity + vec3(motion.angularVelocity.y * r, -motion.angularVelocity.x * r, 0));
  load.biasTorque = vec3(-r * load.biasForce.y, r * load.biasForce.x, 0);
}

/// Solves the joint, all children being summed; keeps u and returns what goes to the parent.
WINDFALL_HD LinkLoad linkUp(const LinksView& links, const LinkStepParameters& step, std::uint32_t i) {
  const LinkShape& shape = links.shape[i];
  const LinkFactor& factor = links.factor[i];
  const LinkLoad& load = links.load[i];
  LinkMotion& motion = links.motion[i];
  const bool root = shape.parent < 0;
  const vec4 parentRotation = root ? vec4(0, 0, 0, 1) : links.before[shape.parent].rotation;
  const vec3 parentPosition = root ? vec3(0) : links.before[shape.parent].position;

  vec3 torque = turnBack(shape.restMatrix, rotateBack(parentRotation, load.torque)) - shape.preStress;
  const vec3 relative = torque / shape.stiffness;
  const float q = glm::dot(relative, relative) / (step.saturation * step.saturation);
  torque *= 1 / std::sqrt(std::sqrt(1 + q * q));
  const vec3 right = torque - shape.stiffness * motion.angle - shape.velocityTerm * motion.speed - load.biasTorque;
  const float* d = factor.inverse;
  motion.answer =
      vec3(d[0] * right.x + d[1] * right.y + d[2] * right.z, d[1] * right.x + d[3] * right.y + d[4] * right.z,
           d[2] * right.x + d[4] * right.y + d[5] * right.z);

  LinkLoad out;
  const float* w = factor.transfer;
  const vec3 biasForce = turn(shape.restMatrix, load.biasForce);
  out.biasForce = biasForce + vec3(w[9] * right.x + w[10] * right.y + w[11] * right.z,
                                   w[12] * right.x + w[13] * right.y + w[14] * right.z,
                                   w[15] * right.x + w[16] * right.y + w[17] * right.z);
  out.biasTorque =
      turn(shape.restMatrix, load.biasTorque) + glm::cross(shape.restOffset, biasForce) +
      vec3(w[0] * right.x + w[1] * right.y + w[2] * right.z, w[3] * right.x + w[4] * right.y + w[5] * right.z,
           w[6] * right.x + w[7] * right.y + w[8] * right.z);
  out.force = load.force;
  out.torque = load.torque + glm::cross(links.before[i].position - parentPosition, load.force);
  return out;
}

WINDFALL_HD void addLoad(LinkLoad& sum, const LinkLoad& part) {
  sum.force += part.force;
  sum.torque += part.torque;
  sum.biasTorque += part.biasTorque;
  sum.biasForce += part.biasForce;
}

/// Poses link i by its joint angle on its posed parent, with the world velocities that follow.
WINDFALL_HD void linkPose(const LinksView& links, std::uint32_t i) {
  const LinkShape& shape = links.shape[i];
  const LinkMotion& motion = links.motion[i];
  LinkState& state = links.after[i];
  const float factor = clampAngle(motion.angle);
  const vec4 joint = exponential(motion.angle * factor);
  const vec3 speed = factor < 1 ? vec3(0) : motion.speed;
  if (shape.parent < 0) {
    state.rotation = renormalise(compose(shape.restRotation, joint));
    state.position = shape.restOffset;
    state.velocity = vec3(0);
    state.angularVelocity = rotate(shape.restRotation, speed);
    return;
  }
  const LinkState& parent = links.after[shape.parent];
  const vec4 frame = compose(parent.rotation, shape.restRotation);
  const vec3 arm = rotate(parent.rotation, shape.restOffset);
  state.rotation = renormalise(compose(frame, joint));
  state.position = parent.position + arm;
  state.velocity = parent.velocity + glm::cross(parent.angularVelocity, arm);
  state.angularVelocity = parent.angularVelocity + rotate(frame, speed);
}

/// Moves joint i, its parent being done: acceleration, integration, pose.
/// `acceleration` holds the joint's (a, b) of the linear system and is what its children read.
WINDFALL_HD void linkDown(const LinksView& links, const LinkStepParameters& step, std::uint32_t i) {
  const LinkShape& shape = links.shape[i];
  LinkMotion& motion = links.motion[i];
  vec3 eta = motion.answer;
  vec3 angular(0), linear(0), turned(0), carried(0);
  if (shape.parent >= 0) {
    // The parent's load slot now carries its acceleration: biasTorque is a, biasForce is b.
    const LinkLoad& parent = links.load[shape.parent];
    const vec3 a = parent.biasTorque, b = parent.biasForce;
    const float* w = links.factor[i].transfer;
    eta -= vec3(w[0] * a.x + w[3] * a.y + w[6] * a.z + w[9] * b.x + w[12] * b.y + w[15] * b.z,
                w[1] * a.x + w[4] * a.y + w[7] * a.z + w[10] * b.x + w[13] * b.y + w[16] * b.z,
                w[2] * a.x + w[5] * a.y + w[8] * a.z + w[11] * b.x + w[14] * b.y + w[17] * b.z);
    angular = turnBack(shape.restMatrix, a);
    linear = turnBack(shape.restMatrix, b + glm::cross(a, shape.restOffset));
    const LinkMotion& moved = links.motion[shape.parent];
    turned = turnBack(shape.restMatrix, moved.angularVelocity);
    carried = turnBack(shape.restMatrix, moved.velocity + glm::cross(moved.angularVelocity, shape.restOffset));
  }
  links.load[i].biasTorque = angular + eta;
  links.load[i].biasForce = linear;
  const vec3 speed = motion.speed + step.h * eta;
  motion.angle += step.h * ((1 - step.implicitness) * motion.speed + step.implicitness * speed);
  motion.speed = speed;
  motion.angularVelocity = turned + speed;
  motion.velocity = carried;
  linkPose(links, i);
}

}  // namespace windfall
