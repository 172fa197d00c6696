// Vectors and turns over any number type: `float`, `double`, or several floats side by side (lanes.h). Branches are
// written as choices, so that all lanes go the same way.
#pragma once

#include <cmath>
#include <cstdint>

#include "kernels/elementary.h"
#include "kernels/math.h"

namespace windfall {

WINDFALL_HD float squareRoot(float a) { return std::sqrt(a); }
WINDFALL_HD double squareRoot(double a) { return std::sqrt(a); }
/// In double precision, for references, the library's functions.
WINDFALL_HD double expOf(double x) { return std::exp(x); }
WINDFALL_HD SinCosOf<double> sinCosTurns(double turns) {
  const double angle = turns * 6.283185307179586477;
  return {std::sin(angle), std::cos(angle)};
}

template <class R>
WINDFALL_HD R largerOf(const R& a, const R& b) {
  return select(a > b, a, b);
}
template <class R>
WINDFALL_HD R smallerOf(const R& a, const R& b) {
  return select(a < b, a, b);
}

template <class R>
struct V3 {
  R x, y, z;
};

template <class R>
WINDFALL_HD V3<R> operator+(const V3<R>& a, const V3<R>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class R>
WINDFALL_HD V3<R> operator-(const V3<R>& a, const V3<R>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class R>
WINDFALL_HD V3<R> operator*(const V3<R>& a, const R& s) {
  return {a.x * s, a.y * s, a.z * s};
}
/// Component by component.
template <class R>
WINDFALL_HD V3<R> scaled(const V3<R>& a, const V3<R>& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class R>
WINDFALL_HD R dotOf(const V3<R>& a, const V3<R>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class R>
WINDFALL_HD V3<R> crossOf(const V3<R>& a, const V3<R>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Unit quaternion.
template <class R>
struct Turn {
  R x, y, z, w;
};

template <class R>
WINDFALL_HD V3<R> turned(const Turn<R>& q, const V3<R>& v) {
  const V3<R> axis{q.x, q.y, q.z};
  const V3<R> half = crossOf(axis, v);
  const V3<R> t = half + half;
  return v + t * q.w + crossOf(axis, t);
}
template <class R>
WINDFALL_HD Turn<R> inverseOf(const Turn<R>& q) {
  return {-q.x, -q.y, -q.z, q.w};
}
template <class R>
WINDFALL_HD V3<R> turnedBack(const Turn<R>& q, const V3<R>& v) {
  return turned(inverseOf(q), v);
}
/// First b, then a.
template <class R>
WINDFALL_HD Turn<R> composed(const Turn<R>& a, const Turn<R>& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
/// One Newton step towards unit length: enough against rounding (tree_dynamics.md, 5.10).
template <class R>
WINDFALL_HD Turn<R> unitOf(const Turn<R>& q) {
  const R n = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  const R s = R(1.5f) - R(0.5f) * n;
  return {q.x * s, q.y * s, q.z * s, q.w * s};
}
/// The local z axis in the outer frame: the branch's direction.
template <class R>
WINDFALL_HD V3<R> alongOf(const Turn<R>& q) {
  const R xz = q.x * q.z + q.w * q.y, yz = q.y * q.z - q.w * q.x, xx = q.x * q.x + q.y * q.y;
  return {xz + xz, yz + yz, R(1.0f) - (xx + xx)};
}

/// Several fields of a slot at once.
template <class R, class Fields>
WINDFALL_HD V3<R> vectorAt(const Fields& fields, std::uint32_t first) {
  return {fields.get(first), fields.get(first + 1), fields.get(first + 2)};
}
template <class R, class Fields>
WINDFALL_HD Turn<R> turnAt(const Fields& fields, std::uint32_t first) {
  return {fields.get(first), fields.get(first + 1), fields.get(first + 2), fields.get(first + 3)};
}
template <class R, class Fields>
WINDFALL_HD void putVector(const Fields& fields, std::uint32_t first, const V3<R>& v) {
  fields.put(first, v.x);
  fields.put(first + 1, v.y);
  fields.put(first + 2, v.z);
}

/// Largest angle that a joint shows, rad (tree_dynamics.md, 5.5).
inline constexpr float kLargestJointAngle = 1.5f;

/// Factor that brings a rotation vector to at most kLargestJointAngle; 0 for what is no number.
template <class R>
WINDFALL_HD R shownPart(const V3<R>& v) {
  const R square = dotOf(v, v);
  const R limit(kLargestJointAngle * kLargestJointAngle);
  const R factor = R(kLargestJointAngle) / squareRoot(largerOf(square, limit));
  return select(square <= limit, R(1.0f), select(square > limit, factor, R(0.0f)));
}

/// Unit quaternion of a rotation vector of at most kLargestJointAngle; polynomials, error below 3e-8.
template <class R>
WINDFALL_HD Turn<R> exponentialOf(const V3<R>& v) {
  const R y = R(0.25f) * dotOf(v, v);
  const R c =
      R(1.0f) + y * (R(-0.5f) + y * (R(1.f / 24) + y * (R(-1.f / 720) + y * (R(1.f / 40320) + y * R(-1.f / 3628800)))));
  const R s = R(0.5f) + y * (R(-1.f / 12) + y * (R(1.f / 240) + y * (R(-1.f / 10080) + y * R(1.f / 725760))));
  return {v.x * s, v.y * s, v.z * s, c};
}

/// In double precision, for references, by the library's functions.
WINDFALL_HD Turn<double> exponentialOf(const V3<double>& v) {
  const double angle = std::sqrt(dotOf(v, v));
  const double s = angle > 1e-8 ? std::sin(0.5 * angle) / angle : 0.5;
  return {v.x * s, v.y * s, v.z * s, std::cos(0.5 * angle)};
}

}  // namespace windfall
