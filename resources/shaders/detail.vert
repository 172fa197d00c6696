#include "frame.glsl"
#define WATCHED
#include "detail_vertex.glsl"
layout(std430, binding = 1) readonly buffer Highlights { uint highlightBits[]; };
layout(std430, binding = 7) readonly buffer LinkColors { uint linkColors[]; };
layout(std430, binding = 3) readonly buffer Barks { vec4 barks[]; };  // colour and width of the tile, look, twigs, mean
invariant gl_Position;

layout(location = 0) out vec3 worldPosition;
layout(location = 1) centroid out vec3 worldNormal;
layout(location = 2) out vec2 textureUv;
layout(location = 3) out vec3 restPosition;
layout(location = 4) out vec3 restNormal;
layout(location = 5) out float highlight;
layout(location = 6) centroid out vec3 around;
layout(location = 7) centroid out vec3 behind;
layout(location = 8) out vec4 air;
layout(location = 9) out float barkRepeats;
layout(location = 10) out vec4 barkTint;
layout(location = 11) out vec4 dataColor;
layout(location = 12) flat out uint layer;
layout(location = 13) out float twig;
layout(location = 14) flat out vec4 baseColor;
layout(location = 15) flat out vec4 look;
layout(location = 16) flat out vec3 twigColor;
layout(location = 17) flat out vec4 meanColor;

void main() {
  Corner at = corner();
  worldPosition = at.position;
  worldNormal = at.normal;
  textureUv = at.bark;
  // Unrolled: the noise runs round and along every branch alike.
  restPosition = vec3(at.round.x, at.bark.y * 6.28318531, at.round.y) * 0.12;
  restNormal = vec3(at.round.x, 0.0, at.round.y);
  uint link = at.link & 0xffffffu;
  layer = at.link >> 24u;
  baseColor = barks[4u * layer];
  look = barks[4u * layer + 1u];
  twigColor = barks[4u * layer + 2u].rgb;
  meanColor = barks[4u * layer + 3u];
  highlight = accent.w > 0.0 ? float((highlightBits[link >> 5u] >> (link & 31u)) & 1u) : 0.0;
  dataColor = linkColors.length() > 1 ? unpackUnorm4x8(linkColors[link]) : vec4(0.0);
  barkTint = unpackUnorm4x8(at.tint);
  // Green stems have finer bark.
  float tile = baseColor.w * (1.0 + 2.0 * barkTint.a) / 3.0;
  barkRepeats = tile > 0.0 ? max(0.0, log2(6.28318531 * at.radius / tile)) : 0.0;
  // Thinner than this there is no bark.
  float thin = barks[4u * layer + 2u].w;
  twig = thin > 0.0 ? 1.0 - smoothstep(0.9 * thin, 1.1 * thin, at.radius) : 0.0;
  float open = canopyOpenness(worldPosition, worldNormal) * mix(0.55, 1.0, smoothstep(0.0, 0.9, worldPosition.y));
  around = ambientLight(worldNormal) * open;
  behind = around;
  air = airBefore(worldPosition);
  gl_Position = viewProjection * vec4(worldPosition, 1.0);
}
