#include "sim/axis_modes.h"

namespace windfall::sim {

namespace {

using glm::dmat3;
using glm::dvec3;

/// A composite about a point `d` away from its own, world axes.
Composite moved(const Composite& c, const dvec3& d) {
  const dmat3 one(1);
  Composite out = c;
  out.moment += c.mass * d;
  out.inertia += c.mass * (glm::dot(d, d) * one - glm::outerProduct(d, d)) + 2 * glm::dot(c.moment, d) * one -
                 glm::outerProduct(c.moment, d) - glm::outerProduct(d, c.moment);
  return out;
}

Composite without(Composite a, const Composite& b) {
  a.mass -= b.mass;
  a.moment -= b.moment;
  a.inertia -= b.inertia;
  return a;
}

constexpr int kIterations = 3;  // of Stodola, from the bend of a uniform load

}  // namespace

AxisModes::AxisModes(std::size_t longest) {
  for (auto* lumps : {&mass_, &drag_}) lumps->reserve(longest);
  for (auto* vectors : {&force_, &angle_, &torque_, &draft_}) vectors->reserve(longest);
}

void AxisModes::toLumps(std::span<const LinkBody> bodies, std::span<const Composite> composites,
                        std::vector<Composite>& lumps) {
  lumps.assign(composites.begin(), composites.end());
  for (std::size_t k = 0; k + 1 < lumps.size(); ++k) {
    lumps[k] = without(lumps[k], moved(composites[k + 1], bodies[k + 1].joint - bodies[k].joint));
  }
}

/// Torques M theta in the joints' frames.
void AxisModes::massTimes(const std::vector<Composite>& lumps, const Vectors& angle, Vectors& torque) {
  const std::size_t n = bodies_.size();
  force_.resize(n);
  torque.resize(n);
  dvec3 a(0), b(0);
  for (std::size_t k = 0; k < n; ++k) {
    if (k > 0) b += glm::cross(a, step(k));
    a += bodies_[k].axes * angle[k];
    const Composite& lump = lumps[k];
    force_[k] = lump.mass * b + glm::cross(a, lump.moment);
    torque[k] = lump.inertia * a + glm::cross(lump.moment, b);
  }
  sum(torque);
}

/// Torques of a load per mass along `direction`.
void AxisModes::load(const std::vector<Composite>& lumps, const dvec3& direction) {
  const std::size_t n = bodies_.size();
  force_.resize(n);
  torque_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    force_[k] = lumps[k].mass * direction;
    torque_[k] = glm::cross(lumps[k].moment, direction);
  }
  sum(torque_);
}

/// From the tip to the base, then into the joints' frames.
void AxisModes::sum(Vectors& torque) {
  for (std::size_t k = bodies_.size(); k-- > 1;) {
    torque[k - 1] += torque[k] + glm::cross(step(k), force_[k]);
    force_[k - 1] += force_[k];
  }
  for (std::size_t k = 0; k < bodies_.size(); ++k) torque[k] = glm::transpose(bodies_[k].axes) * torque[k];
}

AxisMode AxisModes::modeOf(const AxisLinks& links) {
  bodies_ = links.bodies;
  toLumps(links.bodies, links.composites, mass_);
  toLumps(links.bodies, links.drags, drag_);
  const std::size_t n = bodies_.size();
  double elastic = 0, kinetic = 0, air = 0;
  for (int side = 0; side < 2; ++side) {
    load(mass_, bodies_[0].axes[side]);
    angle_.resize(n);
    for (int iteration = 0; iteration <= kIterations; ++iteration) {
      for (std::size_t k = 0; k < n; ++k) angle_[k] = torque_[k] / bodies_[k].stiffness;
      double size = 0;
      for (const dvec3& a : angle_) size += glm::dot(a, a);
      if (!(size > 0)) return {};
      for (dvec3& a : angle_) a /= std::sqrt(size);
      massTimes(mass_, angle_, torque_);
    }
    massTimes(drag_, angle_, draft_);
    for (std::size_t k = 0; k < n; ++k) {
      elastic += glm::dot(angle_[k], bodies_[k].stiffness * angle_[k]);
      kinetic += glm::dot(angle_[k], torque_[k]);
      air += glm::dot(angle_[k], draft_[k]);
    }
  }
  return kinetic > 0 ? AxisMode{elastic / kinetic, air / kinetic} : AxisMode{};
}

}  // namespace windfall::sim
