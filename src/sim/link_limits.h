// What a link's numbers may be: what problemOf() asks for and repairTree() sees to. The limits are far beyond any plant
// and keep single precision from overflowing.
#pragma once

#include <cmath>

#include "sim/tree.h"

namespace windfall::sim {

inline constexpr float kLongest = 1e4f;        ///< m
inline constexpr float kThickest = 1e3f;       ///< radius, m
inline constexpr float kLargestFactor = 1e6f;  ///< also m2 of leaves

/// Not a number counts as outside.
inline bool isWithin(float value, float low, float high) { return value >= low && value <= high; }

inline bool isPlace(const vec3& v) {
  return isWithin(v.x, -1e6f, 1e6f) && isWithin(v.y, -1e6f, 1e6f) && isWithin(v.z, -1e6f, 1e6f);
}
inline bool isUnit(const quat& q) { return isWithin(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 0.98f, 1.02f); }
inline bool isLength(float metres) { return isWithin(metres, 1e-6f, kLongest); }
inline bool isRadius(float metres) { return isWithin(metres, 1e-7f, kThickest); }
inline bool isDensity(float value) { return isWithin(value, 1e-3f, 1e6f); }
inline bool isModulus(float value) { return isWithin(value, 1, 1e15f); }
/// Areas, multipliers and dampings.
inline bool isFactor(float value) { return isWithin(value, 0, kLargestFactor); }
inline bool isSite(const LeafSite& site, std::int32_t links) {
  return site.link >= 0 && site.link < links && isPlace(site.position) && isUnit(site.rotation) &&
         isWithin(site.size, 0, 1e3f);
}

}  // namespace windfall::sim
