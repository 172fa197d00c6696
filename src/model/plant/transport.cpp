#include "model/plant/transport.h"

#include <cmath>

namespace windfall::model {

namespace {

/// Without its part along t; some normal where nothing is left.
template <class V>
V projected(V n, V t) {
  const V rest = n - t * glm::dot(t, n);
  const auto length = glm::length(rest);
  if (length > 1e-6f) return rest / length;
  return glm::normalize(glm::cross(t, std::abs(t.x) < 0.9f ? V(1, 0, 0) : V(0, 0, 1)));
}

}  // namespace

template <class V>
V rotatedAlong(V t0, V t1, V n0) {
  using T = typename V::value_type;
  const V b = glm::cross(t0, t1);
  const T sine = glm::length(b), cosine = glm::dot(t0, t1);
  if (sine < T(1e-12)) return projected(n0, t1);
  // Never acos: it loses everything near 0 and gives NaN just above 1.
  const T angle = std::atan2(sine, cosine);
  const V axis = b / sine;
  const V turned = n0 * std::cos(angle) + glm::cross(axis, n0) * std::sin(angle) +
                   axis * (glm::dot(axis, n0) * (1 - std::cos(angle)));
  return projected(turned, t1);
}

template <class V>
V carriedAlong(V x0, V t0, V n0, V x1, V t1) {
  using T = typename V::value_type;
  const V v1 = x1 - x0;
  const T c1 = glm::dot(v1, v1);
  if (c1 < T(1e-20)) return rotatedAlong(t0, t1, n0);
  const V nl = n0 - 2 / c1 * glm::dot(v1, n0) * v1;
  const V tl = t0 - 2 / c1 * glm::dot(v1, t0) * v1;
  const V v2 = t1 - tl;
  const T c2 = glm::dot(v2, v2);
  return projected(c2 < T(1e-20) ? nl : nl - 2 / c2 * glm::dot(v2, nl) * v2, t1);
}

vec3 startNormal(vec3 tangent, float yaw) {
  const vec3 level(std::sin(yaw), 0, std::cos(yaw));
  return projected(std::abs(glm::dot(tangent, level)) > 0.9f ? vec3(std::cos(yaw), 0, -std::sin(yaw)) : level, tangent);
}

template vec3 rotatedAlong(vec3, vec3, vec3);
template vec3 carriedAlong(vec3, vec3, vec3, vec3, vec3);
template glm::dvec3 rotatedAlong(glm::dvec3, glm::dvec3, glm::dvec3);
template glm::dvec3 carriedAlong(glm::dvec3, glm::dvec3, glm::dvec3, glm::dvec3, glm::dvec3);

}  // namespace windfall::model
