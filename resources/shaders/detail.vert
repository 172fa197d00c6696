#include "frame.glsl"
#define WATCHED
#include "detail_vertex.glsl"
#include "wood.glsl"
layout(std430, binding = 1) readonly buffer Highlights { uint highlightBits[]; };
layout(std430, binding = 7) readonly buffer LinkColors { uint linkColors[]; };
layout(std430, binding = 3) readonly buffer Barks { vec4 barks[]; };  // colour and width of the tile, look, twigs, mean
invariant gl_Position;

// What is drawn may cover no middle of a pixel: there its slopes would carry colours below zero.
layout(location = 1) centroid out vec3 worldNormal;
#ifdef THIN
layout(location = 0) centroid out vec3 worldPosition;
layout(location = 2) centroid out vec3 albedo;
layout(location = 3) centroid out vec3 around;
layout(location = 4) centroid out vec4 air;
layout(location = 5) centroid out vec2 shine;
#else
layout(location = 0) out vec3 worldPosition;
layout(location = 2) out vec2 textureUv;
layout(location = 3) out vec3 restPosition;
layout(location = 4) out vec3 restNormal;
layout(location = 5) centroid out float highlight;
layout(location = 6) centroid out vec3 around;
layout(location = 7) centroid out vec3 behind;
layout(location = 8) centroid out vec4 air;
layout(location = 9) out float barkRepeats;
layout(location = 10) centroid out vec4 barkTint;
layout(location = 11) centroid out vec4 dataColor;
layout(location = 12) flat out uint layer;
layout(location = 13) centroid out float twig;
layout(location = 14) flat out vec4 baseColor;
layout(location = 15) flat out vec4 look;
layout(location = 16) flat out vec3 twigColor;
layout(location = 17) flat out vec4 meanColor;
#endif

void main() {
  Corner at = corner();
  worldPosition = at.position;
  worldNormal = at.normal;
  float open = canopyOpenness(worldPosition, worldNormal) * mix(0.55, 1.0, smoothstep(0.0, 0.9, worldPosition.y));
  around = ambientLight(worldNormal) * open;
  air = airBefore(worldPosition);
  gl_Position = viewProjection * vec4(worldPosition, 1.0);

  uint link = at.link & 0xffffffu, first = 4u * (at.link >> 24u);
  float chosen = accent.w > 0.0 ? float((highlightBits[link >> 5u] >> (link & 31u)) & 1u) : 0.0;
  vec4 data = linkColors.length() > 1 ? unpackUnorm4x8(linkColors[link]) : vec4(0.0);
  vec4 tint = unpackUnorm4x8(at.tint);
  vec4 base = barks[first], shown = barks[first + 1u], thin = barks[first + 2u], mean = barks[first + 3u];
  // Thinner than this there is no bark.
  float bare = thin.w > 0.0 ? 1.0 - smoothstep(0.9 * thin.w, 1.1 * thin.w, at.radius) : 0.0;
#ifdef THIN
  // Without a picture, as light as noise leaves it on a mean.
  float relief = shown.y > 0.5 ? 1.0 : 0.65;
  albedo = woodAlbedo(base.rgb * mean.rgb / max(mean.a, 1e-3), mean.rgb, tint, data, thin.rgb, bare) * relief;
  shine = vec2(shown.x, chosen);
#else
  textureUv = at.bark;
  // Unrolled: the noise runs round and along every branch alike.
  restPosition = vec3(at.round.x, at.bark.y * 6.28318531, at.round.y) * 0.12;
  restNormal = vec3(at.round.x, 0.0, at.round.y);
  layer = at.link >> 24u;
  baseColor = base;
  look = shown;
  twigColor = thin.rgb;
  meanColor = mean;
  highlight = chosen;
  dataColor = data;
  barkTint = tint;
  twig = bare;
  // Green stems have finer bark.
  float tile = base.w * (1.0 + 2.0 * tint.a) / 3.0;
  barkRepeats = tile > 0.0 ? max(0.0, log2(6.28318531 * at.radius / tile)) : 0.0;
  behind = around;
#endif
}
