// Which clusters and boughs are drawn as cards: FADE before the leaves are sorted, LIST after.
layout(local_size_x = 64) in;
#include "cards.glsl"
layout(std430, binding = 10) buffer CardStates { uvec2 cardStates[]; };  // fade, area of the leaves there in mm2
layout(location = 0) uniform mat4 viewProjection;
layout(location = 1) uniform vec4 eyeAndScale;  // position, pixels a radian
layout(location = 2) uniform uvec4 range;       // first instance, number, first node, plant
layout(location = 3) uniform vec2 limits;       // px of a leaf below which its cluster is a card; px of a picture

#ifdef FADE
// Pixels that `length` m take at a node.
float pixelsAt(uvec2 card, CardNode node, float size) {
  vec3 center = (cardPose(card, node) * vec4(node.sphere.xyz, 1.0)).xyz;
  return size * eyeAndScale.w / max(distance(center, eyeAndScale.xyz), 0.05);
}

// A card is never drawn much coarser than the screen, nor where its leaves can be seen one by one.
float fadeOf(uvec2 card, CardNode node) {
  float leaf = pixelsAt(card, node, node.spread.w), whole = leaf * 2.0 * node.sphere.w / max(node.spread.w, 1e-6);
  float small = 1.0 - smoothstep(limits.x, 1.35 * limits.x, leaf);
  bool bough = node.place.y < 0;
  return node.spread.w <= 0.0 ? 0.0 : small * (1.0 - smoothstep(bough ? 0.7 * limits.y : 1.1 * limits.y,
                                                                bough ? 0.95 * limits.y : 1.5 * limits.y, whole));
}

void main() {
  if (gl_GlobalInvocationID.x >= range.y) return;
  uint at = range.x + gl_GlobalInvocationID.x;
  uvec2 card = cardInstances[at];
  CardNode node = cardNodes[card.x];
  float fade = fadeOf(card, node);
  if (node.place.y >= 0) fade = max(fade, fadeOf(card, cardNodes[range.z + uint(node.place.y)]));
  cardStates[at] = uvec2(floatBitsToUint(fade), 0u);
}
#else
struct Command {
  uint count, instances, first, baseInstance;
};
layout(std430, binding = 6) writeonly buffer CardList { uvec4 cardList[]; };
layout(std430, binding = 8) buffer CardCommands { Command cardCommands[]; };

void main() {
  if (gl_GlobalInvocationID.x >= range.y) return;
  uint at = range.x + gl_GlobalInvocationID.x;
  uvec2 card = cardInstances[at];
  CardNode node = cardNodes[card.x];
  uint local = card.x - range.z, present = cardStates[at].y;
  float low = 0.0, high = uintBitsToFloat(cardStates[at].x);
  if (node.place.y >= 0) {
    low = uintBitsToFloat(cardStates[at - local + uint(node.place.y)].x);
  } else if (high > 0.0) {
    for (uint i = 0u; i < uint(node.place.w); ++i) present += cardStates[at - local + uint(node.place.z) + i].y;
  }
  if (high <= low || present == 0u) return;
  float share = float(present) * 1e-6 / max(node.spreadAndArea.w, 1e-12);
  vec4 clip = viewProjection * vec4((cardPose(card, node) * vec4(node.sphere.xyz, 1.0)).xyz, 1.0);
  vec3 row0 = vec3(viewProjection[0][0], viewProjection[1][0], viewProjection[2][0]);
  vec3 row1 = vec3(viewProjection[0][1], viewProjection[1][1], viewProjection[2][1]);
  float reach = 1.5 * node.sphere.w;
  bool seen = clip.w > -reach && abs(clip.x) < clip.w + reach * (1.0 + length(row0)) &&
              abs(clip.y) < clip.w + reach * (1.0 + length(row1));
  uint slot = atomicAdd(cardCommands[range.w].instances, 1u);
  cardList[range.x + slot] = uvec4(at, packUnorm2x16(vec2(low, high)), floatBitsToUint(share), seen ? 1u : 0u);
}
#endif
