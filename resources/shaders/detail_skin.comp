// Moves every ring with its link, and chooses its number of sides. A row of groups for each tree.
#include "detail_select.glsl"

float smoothLevel(float radius, float d, uint level) {
  if (level == 0u) return 0.0;
  float x = min(d / max(radius * camera.w, 1e-9), 1.0);
  float sides = 3.14159265 / acos(1.0 - x);
  float top = float(level);
  return clamp(log2(sides / 3.0), top - 0.9999, top);
}

float widening(vec4 table[3], float e) {
  float below = 0.0;
  for (int k = 1; k < 12; ++k) {
    float above = 3e-4 * float(1 << k);
    if (e < above) {
      float low = table[(k - 1) / 4][(k - 1) % 4], high = table[k / 4][k % 4];
      return low + (high - low) * (e - below) / (above - below);
    }
    below = above;
  }
  return table[2].w;
}

void main() {
  Tree tree = trees[gl_GlobalInvocationID.y];
  uint index = gl_GlobalInvocationID.x;
  if (index >= tree.ringCount) return;
  Ring ring = rings[tree.firstRing + index];
  mat4 bone = bones[tree.firstLink + ring.link];
  vec3 position = moved(bone, ring.place.xyz);
  float d2 = distance2(position), d = sqrt(d2);
  SkinnedRing result;
  result.level = smoothLevel(ring.place.w, d, radialLevel(ring.place.w, d2));
  float sides = 3.0 * exp2(ceil(result.level) - slide(result.level));
  float turn = 3.14159265 / sides;
  result.place = vec4(position, ring.place.w * turn / sin(turn) * widening(tree.widening, d / camera.w));
  result.along = vec4(turned(bone, ring.along.xyz), ring.along.w);
  result.across = vec4(turned(bone, ring.across.xyz), ring.across.w);
  result.outwards = vec4(turned(bone, ring.outwards.xyz), ring.outwards.w);
  result.reach = ring.reach;
  result.link = (tree.firstLink + ring.link) | (tree.layer << 24u);
  result.tint = ring.tint;
  skinned[tree.firstSkinned + index] = result;
}
