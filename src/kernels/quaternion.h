// Ways between unit quaternions (vec4 x, y, z, w), and their 32-bit form.
#pragma once

#include <cmath>

#include "kernels/elementary.h"
#include "kernels/math.h"
#include "kernels/rotation.h"

namespace windfall {

WINDFALL_HD vec4 normalized(const vec4& q) {
  const float scale = 1.0f / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return {q.x * scale, q.y * scale, q.z * scale, q.w * scale};
}

/// From a to b the short way, normalized linear interpolation.
WINDFALL_HD vec4 interpolated(const vec4& a, const vec4& b, float weight) {
  const float sign = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w < 0.0f ? -weight : weight;
  const float rest = 1.0f - weight;
  return normalized(
      {a.x * rest + b.x * sign, a.y * rest + b.y * sign, a.z * rest + b.z * sign, a.w * rest + b.w * sign});
}

/// The part `weight` of the way from q (w >= 0) to no turn at all; not of unit length. Where q and -q are as near it
/// still has one value.
WINDFALL_HD vec4 fading(const vec4& q, float weight) {
  const float rest = 1.0f - weight;
  // The floor keeps a half turn from passing through zero.
  const float w = q.w * rest + weight;
  return {q.x * rest, q.y * rest, q.z * rest, w > 1e-6f ? w : 1e-6f};
}

/// Turn by `turns` (1 = 360 degrees) about a unit axis.
WINDFALL_HD vec4 turnAbout(const vec3& axis, float turns) {
  const SinCos half = sinCosTurns(0.5f * turns);
  return {axis.x * half.sin, axis.y * half.sin, axis.z * half.sin, half.cos};
}

/// The three smallest components with 10 bits each and the index of the largest: error median 0.09, at most 0.25
/// degrees.
WINDFALL_HD std::uint32_t packed(const vec4& q) {
  const float ax = std::fabs(q.x), ay = std::fabs(q.y), az = std::fabs(q.z), aw = std::fabs(q.w);
  const bool isW = aw >= ax && aw >= ay && aw >= az;
  const bool isZ = !isW && az >= ax && az >= ay;
  const bool isY = !isW && !isZ && ay >= ax;
  const float largest = isW ? q.w : isZ ? q.z : isY ? q.y : q.x;
  const float scale = largest < 0.0f ? -722.6631f : 722.6631f;  // 511 * sqrt(2)
  const float a = isW || isZ || isY ? q.x : q.y;
  const float b = isW || isZ ? q.y : q.z;
  const float c = isW ? q.z : q.w;
  const std::uint32_t index = isW ? 3u : isZ ? 2u : isY ? 1u : 0u;
  const float middle = kRounder + 512.0f;
  return ((bitsOf(a * scale + middle) & 1023u) << 22u) | ((bitsOf(b * scale + middle) & 1023u) << 12u) |
         ((bitsOf(c * scale + middle) & 1023u) << 2u) | index;
}

WINDFALL_HD vec4 unpacked(std::uint32_t bits) {
  // An integer below 2^23 in the mantissa of 2^23: conversion without a branch on any instruction set.
  const float unit = 1.0f / 722.6631f;
  const float a = (floatOf(0x4b000000u | (bits >> 22u)) - 8389120.0f) * unit;
  const float b = (floatOf(0x4b000000u | ((bits >> 12u) & 1023u)) - 8389120.0f) * unit;
  const float c = (floatOf(0x4b000000u | ((bits >> 2u) & 1023u)) - 8389120.0f) * unit;
  const float square = 1.0f - a * a - b * b - c * c;
  const float largest = std::sqrt(square > 0.0f ? square : 0.0f);
  const std::uint32_t index = bits & 3u;
  return {index == 0u ? largest : a,
          index == 0u   ? a
          : index == 1u ? largest
                        : b,
          index <= 1u   ? b
          : index == 2u ? largest
                        : c,
          index == 3u ? largest : c};
}

}  // namespace windfall
