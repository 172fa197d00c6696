#include "sim/bodies.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "sim/link_limits.h"

namespace windfall::sim {

namespace {
constexpr double kAirDensity = 1.2;          // kg/m3
constexpr double kLeafMassPerArea = 0.18;    // kg/m2, fresh (2.1)
constexpr double kLeafLeverSquare = 0.0025;  // m2: leaves hang 5 cm off the axis
constexpr double kLeafDrag = 0.15;           // per one-sided area (2.4)
constexpr double kShearRatio = 1.0 / 8;      // twist over bending stiffness (2.2)
constexpr double kSmallestScale = 1e-6;      // of stiffness

double sectionOf(const Link& link) {
  const double r = static_cast<double>(link.radius);
  const double scale = std::max(static_cast<double>(link.stiffnessScale), kSmallestScale);
  return static_cast<double>(link.youngsModulus) * scale * std::numbers::pi * r * r * r * r / 4;
}
}  // namespace

LinkMass massOf(const Link& link) {
  const double r = static_cast<double>(link.radius);
  LinkMass mass;
  mass.wood = static_cast<float>(static_cast<double>(link.woodDensity) * std::numbers::pi * r * r *
                                 static_cast<double>(link.length));
  mass.leaves = static_cast<float>(kLeafMassPerArea * static_cast<double>(link.leafArea));
  return mass;
}

double totalMass(const Tree& tree) {
  double sum = 0;
  for (const Link& link : tree.links) {
    const LinkMass mass = massOf(link);
    sum += static_cast<double>(mass.wood) + static_cast<double>(mass.leaves);
  }
  return sum;
}

double firstFrequency(const Tree& tree) {
  return tree.links.empty() || !problemOf(tree).empty() ? 0 : firstFrequency(bodiesOf(tree));
}

Ground::Ground(const Placement& placement)
    : position(placement.position), turn(glm::angleAxis(static_cast<double>(placement.heading), glm::dvec3(0, 1, 0))) {}

LinkBody bodyOf(const Tree& tree, std::size_t i, const Ground& ground, double lostArea) {
  const Link& link = tree.links[i];
  LinkBody body;
  const double area = std::max(0.0, static_cast<double>(link.leafArea) - lostArea);
  const double wood = static_cast<double>(massOf(link).wood), leaves = kLeafMassPerArea * area;
  body.parent = link.parent;
  body.rotation = glm::normalize(ground.turn * glm::dquat(link.rotation));
  body.axes = glm::mat3_cast(body.rotation);
  body.joint = ground.position + ground.turn * glm::dvec3(link.joint);
  body.length = static_cast<double>(link.length);
  body.radius = static_cast<double>(link.radius);
  body.mass = wood + leaves;
  const double square = body.radius * body.radius;
  body.across = body.mass * (3 * square + body.length * body.length) / 12;
  body.along = wood * square / 2 + leaves * kLeafLeverSquare;
  double compliance = 0.5 * body.length / sectionOf(link);
  if (link.parent >= 0 && tree.links[static_cast<std::size_t>(link.parent)].chain == link.chain) {
    const Link& parent = tree.links[static_cast<std::size_t>(link.parent)];
    body.continues = true;
    compliance += 0.5 * static_cast<double>(parent.length) / sectionOf(parent);
  }
  body.stiffness = glm::dvec3(1, 1, kShearRatio) / compliance;
  body.dampingScale = static_cast<double>(link.dampingScale);
  body.rayleighAlpha = static_cast<double>(link.rayleighAlpha);
  body.rayleighBeta = static_cast<double>(link.rayleighBeta);
  body.propagation = static_cast<double>(link.propagation);
  const double wind = static_cast<double>(link.windScale);
  body.woodDrag = 0.5 * kAirDensity * 2 * body.radius * body.length * wind;
  body.leafDrag = 0.5 * kAirDensity * kLeafDrag * area * wind;
  return body;
}

std::vector<LinkBody> bodiesOf(const Tree& tree, const Placement& placement, std::span<const float> lostArea) {
  std::vector<LinkBody> bodies;
  bodies.reserve(tree.links.size());
  const Ground ground(placement);
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    bodies.push_back(bodyOf(tree, i, ground, lostArea.empty() ? 0 : static_cast<double>(lostArea[i])));
  }
  return bodies;
}

void Composite::add(const LinkBody& body) {
  const glm::dmat3 one(1);
  const glm::dvec3 r = body.arm();
  const glm::dmat3 local(glm::dvec3(body.across, 0, 0), glm::dvec3(0, body.across, 0), glm::dvec3(0, 0, body.along));
  mass += body.mass;
  moment += body.mass * r;
  inertia +=
      body.axes * local * glm::transpose(body.axes) + body.mass * (glm::dot(r, r) * one - glm::outerProduct(r, r));
}

void Composite::add(const Composite& child, const glm::dvec3& d) {
  const glm::dmat3 one(1);
  mass += child.mass;
  moment += child.moment + child.mass * d;
  inertia += child.inertia + child.mass * (glm::dot(d, d) * one - glm::outerProduct(d, d)) +
             2 * glm::dot(child.moment, d) * one - glm::outerProduct(child.moment, d) -
             glm::outerProduct(d, child.moment);
}

std::vector<Composite> compositesOf(const std::vector<LinkBody>& bodies) {
  std::vector<Composite> all(bodies.size());
  for (std::size_t i = bodies.size(); i-- > 0;) {
    const LinkBody& body = bodies[i];
    all[i].add(body);
    if (body.parent < 0) continue;
    const auto p = static_cast<std::size_t>(body.parent);
    all[p].add(all[i], body.joint - bodies[p].joint);
  }
  return all;
}

double firstFrequency(const std::vector<LinkBody>& bodies) {
  // x <- K^-1 M x (2.7); x is in joint frames, accelerations and forces in world axes.
  const std::size_t n = bodies.size();
  std::vector<glm::dvec3> x(n), a(n), b(n), force(n), torque(n);
  const auto massTimes = [&] {
    for (std::size_t i = 0; i < n; ++i) {
      const LinkBody& body = bodies[i];
      const glm::dvec3 own = body.axes * x[i];
      if (body.parent >= 0) {
        const auto p = static_cast<std::size_t>(body.parent);
        a[i] = a[p] + own;
        b[i] = b[p] + glm::cross(a[p], body.joint - bodies[p].joint);
      } else {
        a[i] = own;
        b[i] = glm::dvec3(0);
      }
      const glm::dvec3 r = body.arm();
      force[i] = body.mass * (b[i] + glm::cross(a[i], r));
      const glm::dvec3 turn = glm::transpose(body.axes) * a[i];
      torque[i] = body.axes * glm::dvec3(body.across * turn.x, body.across * turn.y, body.along * turn.z) +
                  glm::cross(r, force[i]);
    }
  };
  const auto sumUp = [&] {
    for (std::size_t i = n; i-- > 0;) {
      const LinkBody& body = bodies[i];
      if (body.parent < 0) continue;
      const auto p = static_cast<std::size_t>(body.parent);
      force[p] += force[i];
      torque[p] += torque[i] + glm::cross(body.joint - bodies[p].joint, force[i]);
    }
  };
  const auto answer = [&](std::size_t i) { return glm::transpose(bodies[i].axes) * torque[i] / bodies[i].stiffness; };
  // The start: a uniform load across the world's up axis, in no special direction.
  for (std::size_t i = 0; i < n; ++i) {
    force[i] = bodies[i].mass * glm::dvec3(1, 0.1, 0.6);
    torque[i] = glm::cross(bodies[i].arm(), force[i]);
  }
  sumUp();
  for (std::size_t i = 0; i < n; ++i) x[i] = answer(i);
  double square = 0;
  for (int iteration = 0; iteration < 300; ++iteration) {
    massTimes();
    sumUp();
    double elastic = 0, kinetic = 0, norm = 0;
    for (std::size_t i = 0; i < n; ++i) {
      elastic += glm::dot(x[i], bodies[i].stiffness * x[i]);
      kinetic += glm::dot(x[i], glm::transpose(bodies[i].axes) * torque[i]);
      x[i] = answer(i);
      norm += glm::dot(x[i], x[i]);
    }
    if (!(kinetic > 0) || !(norm > 0)) return 0;
    const double scale = 1 / std::sqrt(norm);
    for (glm::dvec3& value : x) value *= scale;
    const double before = square;
    square = elastic / kinetic;
    if (iteration > 3 && std::abs(square - before) < 1e-7 * square) break;
  }
  return std::sqrt(square) / (2 * std::numbers::pi);
}

std::string problemOf(const Tree& tree) {
  const std::string name = tree.name.empty() ? "the tree" : tree.name;
  const auto count = static_cast<std::int32_t>(tree.links.size());
  const auto at = [&](std::int32_t i, const char* what) {
    return "link " + std::to_string(i) + " of " + name + ": " + what;
  };
  std::vector<std::int32_t> open;  // the path from the root to the last link
  for (std::int32_t i = 0; i < count; ++i) {
    const Link& link = tree.links[static_cast<std::size_t>(i)];
    if (link.parent < -1 || link.parent >= i) return at(i, "its parent does not come before it");
    while (!open.empty() && open.back() != link.parent) open.pop_back();
    if (link.parent >= 0 && open.empty()) return at(i, "the links of a subtree do not follow each other");
    open.push_back(i);
    if (!isPlace(link.joint)) return at(i, "its position is not a number or too far away");
    if (!isUnit(link.rotation)) return at(i, "its rotation is not a unit quaternion");
    if (!isLength(link.length)) return at(i, link.length > 1 ? "its length is beyond all measure" : "it has no length");
    if (!isRadius(link.radius)) {
      return at(i, link.radius > 1 ? "its thickness is beyond all measure" : "it has no thickness");
    }
    if (!isDensity(link.woodDensity)) return at(i, "its wood has no density");
    if (!isModulus(link.youngsModulus)) return at(i, "its wood has no stiffness");
    if (!isFactor(link.leafArea)) return at(i, "its leaf area is negative or not a number");
    if (!isFactor(link.stiffnessScale)) return at(i, "its stiffness is negative or not a number");
    if (!isFactor(link.dampingScale)) return at(i, "its damping is negative or not a number");
    if (!isFactor(link.rayleighAlpha) || !isFactor(link.rayleighBeta)) {
      return at(i, "its Rayleigh damping is negative or not a number");
    }
    if (!isFactor(link.propagation)) return at(i, "its propagation is negative or not a number");
    if (!isFactor(link.windScale)) return at(i, "its wind response is negative or not a number");
  }
  for (std::size_t i = 0; i < tree.sites.size(); ++i) {
    if (!isSite(tree.sites[i], count)) return "leaf " + std::to_string(i) + " of " + name + ": it hangs on no link";
  }
  return {};
}

}  // namespace windfall::sim
