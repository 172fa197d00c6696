#include "model/plant/frames.h"

#include <algorithm>
#include <cmath>

namespace windfall::model {

quat alongZ(vec3 direction) {
  const float length = glm::length(direction);
  if (!(length > 1e-12f)) return quat(1, 0, 0, 0);
  const vec3 z = direction / length;
  const vec3 level = glm::cross(vec3(0, 1, 0), z);
  const vec3 x = glm::length(level) > 1e-4f ? glm::normalize(level) : vec3(1, 0, 0);
  const vec3 y = glm::normalize(glm::cross(z, x));
  return glm::normalize(glm::quat_cast(mat3(glm::cross(y, z), y, z)));
}

quat leafRotation(vec3 tip, vec3 up) {
  const float length = glm::length(tip);
  const vec3 y = length > 1e-12f ? tip / length : vec3(0, 1, 0);
  vec3 z = up - y * glm::dot(up, y);
  if (!(glm::length(z) > 1e-4f)) z = glm::cross(y, std::abs(y.x) < 0.9f ? vec3(1, 0, 0) : vec3(0, 0, 1));
  z = glm::normalize(z);
  return glm::normalize(glm::quat_cast(mat3(glm::cross(y, z), y, z)));
}

float closestShare(vec3 a, vec3 b, vec3 point) {
  const vec3 along = b - a;
  const float squared = glm::dot(along, along);
  return squared > 1e-20f ? std::clamp(glm::dot(point - a, along) / squared, 0.0f, 1.0f) : 0.0f;
}

}  // namespace windfall::model
