// Sorts the leaves of a frame into one list for each layer and level of detail, so that one indirect call draws them
// all. Three steps: COUNT, PLAN, PLACE. Kinds 0 to 3: levels of what is in view; 4 and 5: levels 2 and 3 of what only
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

layout(location = 0) uniform mat4 viewProjection;
layout(location = 1) uniform vec4 eyeAndScale;  // position, pixels a radian
layout(location = 2) uniform uint leafCount;

const uint kNone = 0xffffffffu;
const uint kShared = 512u;

#ifndef PLAN
shared uint counted[kShared];
shared uint starts[kShared];

uint levelOf(float pixels) { return pixels > 96.0 ? 0u : pixels > 30.0 ? 1u : pixels > 8.0 ? 2u : 3u; }

uint bucketOf(uint i) {
  if (i >= leafCount || leaves[i].layerAndState.y == kHidden) return kNone;
  uint layerCount = uint(layers.length());
  uint layer = min(leaves[i].layerAndState.x, layerCount - 1u);
  float size = leaves[i].placeAndSize.w;
  // Its middle, roughly: a leaf is seen whole if any part of it is.
  vec3 place = leaves[i].placeAndSize.xyz;
  uint level = levelOf(size * eyeAndScale.w / max(distance(place, eyeAndScale.xyz), 0.05));
  vec4 clip = viewProjection * vec4(place, 1.0);
  vec3 row0 = vec3(viewProjection[0][0], viewProjection[1][0], viewProjection[2][0]);
  vec3 row1 = vec3(viewProjection[0][1], viewProjection[1][1], viewProjection[2][1]);
  float reach = 1.2 * size;
  bool seen = clip.w > -reach && abs(clip.x) < clip.w + reach * (1.0 + length(row0)) &&
              abs(clip.y) < clip.w + reach * (1.0 + length(row1));
  uint kind = seen ? level : max(level, 2u) + 2u;
  return kind * layerCount + layer;
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  uint kinds = uint(commands.length());
  bool few = kinds <= kShared;
#ifdef COUNT
  uint bucket = bucketOf(i);
  if (i < leafCount) buckets[i] = bucket;
#else
  uint bucket = i < leafCount ? buckets[i] : kNone;
#endif
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
    if (bucket != kNone) lists[starts[bucket] + mine] = i;
#endif
  } else if (bucket != kNone) {
    uint at = atomicAdd(cursors[bucket], 1u);
#ifndef COUNT
    lists[at] = i;
#endif
  }
}
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
