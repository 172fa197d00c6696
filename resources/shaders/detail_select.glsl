// Which runs are drawn, and how finely; the same arithmetic in the same order as src/kernels/detail_select.h.
#include "detail.glsl"
layout(std430, binding = 0) readonly buffer Bones { mat4 bones[]; };
layout(std430, binding = 11) readonly buffer Rings { Ring rings[]; };
layout(std430, binding = 3) readonly buffer Entries { Entry entries[]; };
layout(std430, binding = 4) readonly buffer Chains { Chain chains[]; };
layout(std430, binding = 5) readonly buffer Trees { Tree trees[]; };
layout(std430, binding = 6) buffer Skinned { SkinnedRing skinned[]; };
layout(std430, binding = 7) buffer Keys { uint keys[]; };
layout(std430, binding = 8) buffer Commands { uint commands[]; };  // 5 a grid: count, instances, first index, base vertex, base instance
layout(std430, binding = 9) buffer Cursors { uint cursors[]; };
layout(std430, binding = 10) writeonly buffer Runs { uint runs[]; };  // 3 a run
layout(location = 0) uniform vec4 camera;     // eye, scale
layout(location = 1) uniform vec4 planes[4];  // inward
layout(location = 5) uniform float parallel;
layout(local_size_x = 64) in;

const float kSagitta[4] = float[4](0.5, 0.1339746, 0.03407417, 0.008555139);
const float kNearest = 0.05;
const float kBendSeen = 3.0;

float square(vec3 v) {
  precise float s = (v.x * v.x + v.y * v.y) + v.z * v.z;
  return s;
}

vec3 moved(mat4 m, vec3 p) {
  precise vec3 r = (m[0].xyz * p.x + m[1].xyz * p.y) + (m[2].xyz * p.z + m[3].xyz);
  return r;
}

vec3 turned(mat4 m, vec3 d) {
  precise vec3 r = (m[0].xyz * d.x + m[1].xyz * d.y) + m[2].xyz * d.z;
  return r;
}

float side(vec4 plane, vec3 p) {
  precise float s = ((plane.x * p.x + plane.y * p.y) + plane.z * p.z) + plane.w;
  return s;
}

float distance2(vec3 position) {
  if (parallel > 0.0) return 1.0;
  return max(square(position - camera.xyz), kNearest * kNearest);
}

bool reaches(float centre2, float radius, float e) {
  precise float far = e * camera.w;
  if (parallel > 0.0) return far <= 1.0;
  if (far <= kNearest) return true;
  precise float from = far + radius;
  precise float from2 = from * from;
  return from2 <= centre2;
}

uint radialLevel(float radius, float d2) {
  precise float seen = radius * camera.w;
  uint level = 0u;
  for (int k = 0; k < 4; ++k) {
    precise float needed = kSagitta[k] * seen;
    precise float needed2 = needed * needed;
    level += needed2 > d2 ? 1u : 0u;
  }
  return level;
}

uint axialLevel(Entry entry, float d2) {
  precise float seen = kBendSeen * (entry.sag * camera.w);
  precise float seen2 = seen * seen;
  uint level = (seen2 > d2 ? 1u : 0u) + (seen2 > 16.0 * d2 ? 1u : 0u) + (seen2 > 256.0 * d2 ? 1u : 0u);
  precise float large = (entry.radius * camera.w) * 0.125;
  precise float large2 = large * large;
  if (large2 > d2) level = max(level, entry.shape & 3u);
  return level;
}

bool outsideSphere(vec3 centre, float radius) {
  bool outside = false;
  for (int i = 0; i < 4; ++i) outside = outside || side(planes[i], centre) < -radius;
  return outside;
}

// The grid to draw, -1: out of sight.
int gridOf(Entry entry, vec3 a, float radiusA, vec3 b, float radiusB) {
  precise float margin = entry.radius * 1.5 + entry.sag * 2.0;
  for (int i = 0; i < 4; ++i) {
    if (side(planes[i], a) < -margin && side(planes[i], b) < -margin) return -1;
  }
  float a2 = distance2(a), b2 = distance2(b);
  uint radial = max(radialLevel(radiusA, a2), radialLevel(radiusB, b2));
  return int(radial * kAxial + axialLevel(entry, min(a2, b2)));
}
