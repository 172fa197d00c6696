// Sorts the leaves of a frame into one list for each layer and level of detail, so that one indirect call draws them
// all. Four steps: DEMAND, COUNT, PLAN, PLACE. Small leaves are thinned: of those that are seen with less than a few
// pixels only a share is drawn, the same ones in every frame, and these are enlarged so that the area stays (Cook,
// Halstead, Planck, Ryu 2007; plant_meshing.md, 6.5). Kinds 0 to 3: levels of what is in view; 4 and 5: levels 2 and 3 of what only
// throws a shadow into it.
#include "leaf_layers.glsl"
#ifdef PLAN
layout(local_size_x = 1) in;
#else
layout(local_size_x = 256) in;
#endif

struct Command {
  uint count, instances, firstIndex;
  int baseVertex;
  uint baseInstance;
};
layout(std430, binding = 4) buffer Commands { Command commands[]; };
layout(std430, binding = 5) buffer Cursors { uint cursors[]; };
layout(std430, binding = 6) buffer Lists { uint lists[]; };
layout(std430, binding = 7) buffer Kinds { uint buckets[]; };
layout(std430, binding = 8) buffer Demand { uint demand; };  // leaves that would be drawn without a budget, in 64ths

layout(location = 0) uniform mat4 viewProjection;
layout(location = 1) uniform vec4 eyeAndScale;  // position, pixels a radian
layout(location = 2) uniform uint leafCount;
layout(location = 3) uniform vec2 thinning;  // pixels below which leaves are thinned, budget of leaves

#ifndef PLAN
#include "leaf_cards.glsl"
#endif

const uint kNone = 0xffffffffu;
const uint kShared = 512u;

#ifndef PLAN
shared uint counted[kShared];
shared uint starts[kShared];

float pixelsOf(uint i) {
  vec4 place = leaves[i].placeAndSize;
  return place.w * eyeAndScale.w / max(distance(place.xyz, eyeAndScale.xyz), 0.05);
}

// Of leaves that are seen with so many pixels: the share that is drawn. `scarcity` is what the budget leaves of it;
// large leaves, and those in the air, are drawn whatever there are of them.
float shareOf(uint i, float pixels, float scarcity) {
  uint state = leaves[i].layerAndState.y;
  if (state != kAttached && state != kResting) return 1.0;
  float share = max(min(sqrt(pixels / thinning.x), 1.0) * scarcity, 0.02);
  return max(share, smoothstep(10.0, 20.0, pixels));
}

// How large leaf `i` is drawn, 0: not. The last ones of the share shrink before they go.
float scaleOf(uint i, float share) {
  if (share >= 1.0) return 1.0;
  float rank = float(leafBits(i ^ 0x9e3779b9u) >> 8u) / 16777216.0;
  float fading = 0.1 * share * clamp(5.0 - 5.0 * share, 0.01, 1.0);
  float area = min(1.0 / (share - 0.5 * fading), 12.0) * clamp((share - rank) / fading, 0.0, 1.0);
  return sqrt(area);
}

uint levelOf(float pixels) { return pixels > 96.0 ? 0u : pixels > 30.0 ? 1u : pixels > 8.0 ? 2u : 3u; }

uint bucketOf(uint i) {
  if (i >= leafCount || leaves[i].layerAndState.y == kHidden) return kNone;
  uint layerCount = uint(layers.length());
#ifdef COUNT
  float fade = cardFade(i, leaves[i].layerAndState.y);
  if (fade > 0.0) {
    // Cards thin out as their leaves fall.
    vec2 size = vec2(1000.0 * leaves[i].placeAndSize.w);
    atomicAdd(cardStates[leafCards[i]].y, uint(size.x * size.y + 0.5));
    if (fade >= 1.0) return kNone;
  }
#endif
  uint layer = min(leaves[i].layerAndState.x, layerCount - 1u);
  float pixels = pixelsOf(i);
  float scale = scaleOf(i, shareOf(i, pixels, min(1.0, thinning.y * 64.0 / float(max(demand, 1u)))));
  uint steps = uint(scale * (float(kScaleSteps) / kLargestScale) + 0.5);
  if (steps == 0u) return kNone;
  float size = leaves[i].placeAndSize.w * scale;
  // Its middle, roughly: a leaf is seen whole if any part of it is.
  vec3 place = leaves[i].placeAndSize.xyz;
  uint level = levelOf(pixels * scale);
  vec4 clip = viewProjection * vec4(place, 1.0);
  vec3 row0 = vec3(viewProjection[0][0], viewProjection[1][0], viewProjection[2][0]);
  vec3 row1 = vec3(viewProjection[0][1], viewProjection[1][1], viewProjection[2][1]);
  float reach = 1.2 * size;
  bool seen = clip.w > -reach && abs(clip.x) < clip.w + reach * (1.0 + length(row0)) &&
              abs(clip.y) < clip.w + reach * (1.0 + length(row1));
  uint kind = seen ? level : max(level, 2u) + 2u;
  return kind * layerCount + layer | steps << kIndexBits;
}

#ifdef DEMAND
shared uint wanted;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (gl_LocalInvocationIndex == 0u) wanted = 0u;
  barrier();
  if (i < leafCount && leaves[i].layerAndState.y != kHidden && cardFade(i, leaves[i].layerAndState.y) < 1.0) {
    atomicAdd(wanted, uint(64.0 * shareOf(i, pixelsOf(i), 1.0) + 0.5));
  }
  barrier();
  if (gl_LocalInvocationIndex == 0u) atomicAdd(demand, wanted);
}
#else
void main() {
  uint i = gl_GlobalInvocationID.x;
  uint kinds = uint(commands.length());
  bool few = kinds <= kShared;
#ifdef COUNT
  uint found = bucketOf(i);
  if (i < leafCount) buckets[i] = found;
#else
  uint found = i < leafCount ? buckets[i] : kNone;
#endif
  uint bucket = found == kNone ? kNone : found & ((1u << kIndexBits) - 1u);
  uint entry = i | (found & ~((1u << kIndexBits) - 1u));
  if (few) {
    for (uint k = gl_LocalInvocationIndex; k < kinds; k += gl_WorkGroupSize.x) counted[k] = 0u;
    barrier();
    uint mine = bucket != kNone ? atomicAdd(counted[bucket], 1u) : 0u;
    barrier();
#ifdef COUNT
    for (uint k = gl_LocalInvocationIndex; k < kinds; k += gl_WorkGroupSize.x) {
      if (counted[k] > 0u) atomicAdd(cursors[k], counted[k]);
    }
#else
    for (uint k = gl_LocalInvocationIndex; k < kinds; k += gl_WorkGroupSize.x) {
      if (counted[k] > 0u) starts[k] = atomicAdd(cursors[k], counted[k]);
    }
    barrier();
    if (bucket != kNone) lists[starts[bucket] + mine] = entry;
#endif
  } else if (bucket != kNone) {
    uint at = atomicAdd(cursors[bucket], 1u);
#ifndef COUNT
    lists[at] = entry;
#endif
  }
}
#endif
#else
void main() {
  uint kinds = uint(commands.length()), first = 0u;
  for (uint k = 0u; k < kinds; ++k) {
    uint count = cursors[k];
    commands[k].instances = count;
    commands[k].baseInstance = first;
    cursors[k] = first;
    first += count;
  }
}
#endif
