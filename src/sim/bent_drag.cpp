#include "sim/bent_drag.h"

#include <algorithm>
#include <cmath>

namespace windfall::sim {

namespace {

using glm::dmat3;
using glm::dvec3;

constexpr double kGust = 2;            // of the mean wind: it is gusts that twist
constexpr double kLargestAngle = 0.8;  // rad of a joint, as in the solvers' saturation (5.5)

dmat3 turnBy(const dvec3& angle) {
  const double size = glm::length(angle);
  return size > 1e-12 ? glm::mat3_cast(glm::angleAxis(size, angle / size)) : dmat3(1);
}

}  // namespace

BentDrag::BentDrag(const Tree& tree)
    : walk_(tree.links), open_(walk_.depth()), angles_(tree.links.size()), drag_(tree.links.size()) {}

std::size_t BentDrag::bytes() const {
  return open_.size() * sizeof(Open) + angles_.size() * sizeof(dvec3) + drag_.size() * sizeof(double);
}

void BentDrag::begin(const FactorInput& input) {
  input_ = input;
  isCalm_ = !(input.settings.windSpeed > 0);
  input_.settings.windSpeed *= kGust;
  round_ = 0;
  walk_.begin(angles_.size());
}

bool BentDrag::advance(std::size_t& visits) {
  if (isCalm_) return true;
  while (round_ <= kRounds) {
    walk_.advance(input_.tree->links, visits, *this);
    if (!walk_.isDone()) return false;
    if (++round_ <= kRounds) walk_.begin(angles_.size());
  }
  return true;
}

/// Round 0 finds the tree at rest, the others as the round before has turned its joints.
void BentDrag::enter(std::size_t link, std::size_t depth) {
  Open& open = open_[depth];
  open.body = input_.body(link);
  open.leaning = open.body;
  open.leaning.mass = dragSlope(open.body, input_.settings);
  open.leaning.across = open.leaning.along = 0;
  open.frame = open.body.axes;
  open.wind = open.force = input_.settings.windDirection * meanDrag(open.body, input_.settings);
  open.torque = dvec3(0);
  open.drag = {};
  if (round_ == 0) return;
  if (depth > 0) {
    const Open& parent = open_[depth - 1];
    const dmat3 turn = parent.leaning.axes * glm::transpose(parent.body.axes);
    open.frame = turn * open.body.axes;
    open.leaning.joint = parent.leaning.joint + turn * (open.body.joint - parent.body.joint);
  }
  open.leaning.axes = open.frame * turnBy(angles_[link]);
}

void BentDrag::leave(std::size_t link, std::size_t depth) {
  Open& open = open_[depth];
  Open* parent = depth > 0 ? &open_[depth - 1] : nullptr;
  const dvec3 d = parent != nullptr ? open.leaning.joint - parent->leaning.joint : dvec3(0);
  if (round_ == 0 || round_ == kRounds) {
    open.drag.add(open.leaning);
    const dvec3 along = open.frame[2];
    const double twist = glm::dot(along, open.drag.inertia * along);
    drag_[link] = round_ == 0 ? twist : std::max(0.0, twist - drag_[link]);
    if (parent != nullptr) parent->drag.add(open.drag, d);
    if (round_ == kRounds) return;
  }
  // The joint turns towards the angle that carries the wind in this pose.
  open.torque += glm::cross(open.leaning.arm(), open.wind);
  const dvec3 wanted = glm::transpose(open.frame) * open.torque / open.body.stiffness;
  const double size = glm::length(wanted) / kLargestAngle;
  const dvec3 before = round_ == 0 ? dvec3(0) : angles_[link];
  angles_[link] = 0.5 * (before + wanted / std::sqrt(std::sqrt(1 + size * size * size * size)));
  if (parent == nullptr) return;
  parent->force += open.force;
  parent->torque += open.torque + glm::cross(d, open.force);
}

}  // namespace windfall::sim
