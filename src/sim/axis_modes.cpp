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

/// One axis with everything that hangs on each of its links as a rigid lump.
class Axis {
 public:
  void assign(std::span<const std::size_t> path, const std::vector<LinkBody>& bodies,
              const std::vector<Composite>& composites) {
    path_ = path;
    bodies_ = &bodies;
    lumps_.clear();
    for (std::size_t k = 0; k < path.size(); ++k) {
      Composite lump = composites[path[k]];
      if (k + 1 < path.size()) lump = without(lump, moved(composites[path[k + 1]], step(k + 1)));
      lumps_.push_back(lump);
    }
  }

  /// Torques M theta in the joints' frames.
  void massTimes(const std::vector<dvec3>& angle, std::vector<dvec3>& torque) {
    const std::size_t n = path_.size();
    force_.resize(n);
    torque.resize(n);
    dvec3 a(0), b(0);
    for (std::size_t k = 0; k < n; ++k) {
      if (k > 0) b += glm::cross(a, step(k));
      a += body(k).axes * angle[k];
      const Composite& lump = lumps_[k];
      force_[k] = lump.mass * b + glm::cross(a, lump.moment);
      torque[k] = lump.inertia * a + glm::cross(lump.moment, b);
    }
    sum(torque);
  }

  /// Torques of a load per mass along `direction`.
  void load(const dvec3& direction, std::vector<dvec3>& torque) {
    const std::size_t n = path_.size();
    force_.resize(n);
    torque.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
      force_[k] = lumps_[k].mass * direction;
      torque[k] = glm::cross(lumps_[k].moment, direction);
    }
    sum(torque);
  }

  const LinkBody& body(std::size_t k) const { return (*bodies_)[path_[k]]; }
  std::size_t size() const { return path_.size(); }

 private:
  dvec3 step(std::size_t k) const { return body(k).joint - body(k - 1).joint; }

  /// From the tip to the base, then into the joints' frames.
  void sum(std::vector<dvec3>& torque) {
    for (std::size_t k = path_.size(); k-- > 1;) {
      torque[k - 1] += torque[k] + glm::cross(step(k), force_[k]);
      force_[k - 1] += force_[k];
    }
    for (std::size_t k = 0; k < path_.size(); ++k) torque[k] = glm::transpose(body(k).axes) * torque[k];
  }

  std::span<const std::size_t> path_;
  const std::vector<LinkBody>* bodies_ = nullptr;
  std::vector<Composite> lumps_;
  std::vector<dvec3> force_;
};

constexpr int kIterations = 3;  // of Stodola, from the bend of a uniform load

struct Workspace {
  Axis mass, drag;
  std::vector<dvec3> angle, torque, draft;
};

AxisMode modeOf(Workspace& w) {
  const std::size_t n = w.mass.size();
  double elastic = 0, kinetic = 0, air = 0;
  for (int side = 0; side < 2; ++side) {
    w.mass.load(w.mass.body(0).axes[side], w.torque);
    w.angle.resize(n);
    for (int iteration = 0; iteration <= kIterations; ++iteration) {
      for (std::size_t k = 0; k < n; ++k) w.angle[k] = w.torque[k] / w.mass.body(k).stiffness;
      double size = 0;
      for (const dvec3& a : w.angle) size += glm::dot(a, a);
      if (!(size > 0)) return {};
      for (dvec3& a : w.angle) a /= std::sqrt(size);
      w.mass.massTimes(w.angle, w.torque);
    }
    w.drag.massTimes(w.angle, w.draft);
    for (std::size_t k = 0; k < n; ++k) {
      elastic += glm::dot(w.angle[k], w.mass.body(k).stiffness * w.angle[k]);
      kinetic += glm::dot(w.angle[k], w.torque[k]);
      air += glm::dot(w.angle[k], w.draft[k]);
    }
  }
  return kinetic > 0 ? AxisMode{elastic / kinetic, air / kinetic} : AxisMode{};
}

}  // namespace

std::vector<AxisMode> axisModes(const std::vector<LinkBody>& bodies, const std::vector<Composite>& composites,
                                const std::vector<Composite>& drags) {
  constexpr std::size_t kEnd = static_cast<std::size_t>(-1);
  // An axis forks where two children continue it: the first goes on, the others begin anew.
  std::vector<std::size_t> next(bodies.size(), kEnd);
  std::vector<bool> begins(bodies.size(), true);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].continues) continue;
    std::size_t& of = next[static_cast<std::size_t>(bodies[i].parent)];
    if (of != kEnd) continue;
    of = i;
    begins[i] = false;
  }
  std::vector<AxisMode> modes(bodies.size());
  std::vector<std::size_t> path;
  Workspace w;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!begins[i]) continue;
    path.clear();
    for (std::size_t k = i; k != kEnd; k = next[k]) path.push_back(k);
    w.mass.assign(path, bodies, composites);
    w.drag.assign(path, bodies, drags);
    const AxisMode mode = modeOf(w);
    for (const std::size_t k : path) modes[k] = mode;
  }
  return modes;
}

}  // namespace windfall::sim
