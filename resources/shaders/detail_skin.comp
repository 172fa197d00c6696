// Moves every ring with its link, and chooses its number of sides. A row of groups for each tree.
#include "detail_select.glsl"

float smoothLevel(float radius, float d, uint level) {
  if (level == 0u) return 0.0;
  float x = min(d / max(radius * camera.w, 1e-9), 1.0);
  float sides = 3.14159265 / acos(1.0 - x);
  float top = float(level);
  return clamp(log2(sides / 3.0), top - 0.9999, top);
}

float widening(vec4 table[3], float e, float radius) {
  float share = min(1.0, e / max(radius, 1e-9)), below = 0.0;
  e *= 0.75;
  for (int k = 1; k < 12; ++k) {
    float above = 3e-4 * float(1 << k);
    if (e < above) {
      float low = table[(k - 1) / 4][(k - 1) % 4], high = table[k / 4][k % 4];
      return 1.0 + share * (low + (high - low) * (e - below) / (above - below));
    }
    below = above;
  }
  return 1.0 + share * table[2].w;
}

// Ends before the rings at the collar's end are left out.
float collarShown(float seen) { return smoothstep(0.0, 1.0, seen / 6.0 - 1.0); }

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
  result.place = vec4(position, ring.place.w * turn / sin(turn) * widening(tree.widening, d / camera.w, ring.place.w));
  result.along = vec4(turned(bone, ring.along.xyz), ring.along.w);
  result.across = vec4(turned(bone, ring.across.xyz), ring.across.w);
  float shown = ring.reach > 0.0 ? collarShown(ring.place.w / ring.reach * camera.w / d) : 0.0;
  result.outwards = vec4(turned(bone, ring.outwards.xyz), ring.outwards.w + (1.0 - shown) * (1.0 + abs(ring.reach)));
  result.reach = ring.reach;
  result.link = (tree.firstLink + ring.link) | (tree.layer << 24u);
  vec4 tint = unpackUnorm4x8(ring.tint);
  tint.rgb *= 1.0 - 0.35 * ring.collar * shown;
  result.tint = packUnorm4x8(tint);
  skinned[tree.firstSkinned + index] = result;
}
