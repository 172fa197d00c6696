#include "widgets/viewport/picking.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace windfall::widgets {
namespace {

constexpr float kFarthestGround = 1000;  // m

/// Nearest approach of a ray and a segment (Ericson, Real-Time Collision Detection, 5.1.9, with one end open).
struct Approach {
  float along = 0;  ///< on the ray, m
  float gap = 0;    ///< m
};

Approach approach(const Ray& ray, vec3 a, vec3 b) {
  const vec3 e = b - a, r = ray.origin - a;
  const float ee = glm::dot(e, e), de = glm::dot(ray.direction, e), dr = glm::dot(ray.direction, r),
              er = glm::dot(e, r);
  float onSegment = 0;
  if (ee > 1e-12f) {
    const float denominator = ee - de * de;
    const float onRay = denominator > 1e-9f * ee ? std::max((de * er - ee * dr) / denominator, 0.f) : 0.f;
    onSegment = std::clamp((de * onRay + er) / ee, 0.f, 1.f);
  }
  const float along = std::max(onSegment * de - dr, 0.f);
  return {along, glm::length(ray.origin + ray.direction * along - (a + e * onSegment))};
}

vec3 transformed(const mat4& matrix, vec3 place) { return vec3(matrix * vec4(place, 1)); }

}  // namespace

std::vector<LinkCapsule> capsulesOf(const sim::Tree& tree) {
  std::vector<LinkCapsule> capsules;
  capsules.reserve(tree.links.size());
  for (const sim::Link& link : tree.links) {
    capsules.push_back({link.joint, link.joint + link.rotation * vec3(0, 0, link.length), link.radius});
  }
  return capsules;
}

std::optional<Hit> pick(const Ray& ray, std::span<const LinkCapsule> capsules, std::span<const mat4> pose,
                        float slack) {
  std::optional<Hit> met, near;
  float nearest = 1;
  for (std::size_t i = 0; i < std::min(capsules.size(), pose.size()); ++i) {
    const Approach a = approach(ray, transformed(pose[i], capsules[i].from), transformed(pose[i], capsules[i].to));
    const float surface = a.along - capsules[i].radius;
    if (a.gap <= capsules[i].radius) {
      if (!met || surface < met->distance) met = Hit{i, surface};
    } else if (const float width = slack * a.along; a.gap - capsules[i].radius < width) {
      const float share = (a.gap - capsules[i].radius) / width;
      if (share < nearest) {
        nearest = share;
        near = Hit{i, surface};
      }
    }
  }
  return met ? met : near;
}

std::optional<vec3> meetGround(const Ray& ray, float height) {
  if (std::abs(ray.direction.y) < 1e-6f) return std::nullopt;
  const float along = (height - ray.origin.y) / ray.direction.y;
  if (along <= 0 || along > kFarthestGround) return std::nullopt;
  return ray.origin + ray.direction * along;
}

std::optional<Box> boundsOf(std::span<const LinkCapsule> capsules, std::span<const mat4> pose) {
  std::optional<Box> box;
  for (std::size_t i = 0; i < std::min(capsules.size(), pose.size()); ++i) {
    for (const vec3 end : {transformed(pose[i], capsules[i].from), transformed(pose[i], capsules[i].to)}) {
      const vec3 lower = end - capsules[i].radius, upper = end + capsules[i].radius;
      box = box ? Box{glm::min(box->lower, lower), glm::max(box->upper, upper)} : Box{lower, upper};
    }
  }
  return box;
}

}  // namespace windfall::widgets
