#include "frame.glsl"
#include "skin.glsl"
#ifdef PIECES
#include "pieces.glsl"
#endif
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in uvec4 links;
layout(location = 4) in vec4 weights;
layout(location = 5) in uint firstLink;
layout(location = 6) in float repeats;
layout(location = 7) in vec4 tint;
layout(std430, binding = 1) readonly buffer Highlights { uint highlightBits[]; };
layout(std430, binding = 7) readonly buffer LinkColors { uint linkColors[]; };  // one alone: none

layout(location = 0) out vec3 worldPosition;
layout(location = 1) centroid out vec3 worldNormal;
layout(location = 2) out vec2 textureUv;
layout(location = 3) out vec3 restPosition;
layout(location = 4) out vec3 restNormal;
layout(location = 5) centroid out float highlight;
layout(location = 6) centroid out vec3 around;  // diffuse light on the side of the normal, and on the other
layout(location = 7) centroid out vec3 behind;
layout(location = 8) centroid out vec4 air;
layout(location = 9) out float barkRepeats;
layout(location = 10) centroid out vec4 barkTint;
layout(location = 11) centroid out vec4 dataColor;  // sRGB; alpha 0: bark

float highlighted(uint link) {
  uint bit = firstLink + link;
  return float((highlightBits[bit >> 5u] >> (bit & 31u)) & 1u);
}

void main() {
  mat4 skin = skinMatrix(firstLink, links, weights);
  vec3 place = position;
#ifdef PIECES
  place += normal * pieceWidening(firstLink);
#endif
  worldPosition = (skin * vec4(place, 1.0)).xyz;
  worldNormal = mat3(skin) * normal;
  textureUv = uv;
  barkRepeats = repeats;
  barkTint = tint;
  dataColor = vec4(0.0);
  if (linkColors.length() > 1) {
    for (int i = 0; i < 4; ++i) dataColor += unpackUnorm4x8(linkColors[firstLink + links[i]]) * weights[i];
  }
  restPosition = position;
  restNormal = normal;
  highlight = accent.w > 0.0 ? dot(vec4(highlighted(links.x), highlighted(links.y), highlighted(links.z), highlighted(links.w)), weights) : 0.0;
  vec3 outwards = normalize(worldNormal);
  float open = canopyOpenness(worldPosition, outwards) * mix(0.55, 1.0, smoothstep(0.0, 0.9, worldPosition.y));
  around = ambientLight(outwards) * open;
  behind = ambientLight(-outwards) * open;
  air = airBefore(worldPosition);
  gl_Position = viewProjection * vec4(worldPosition, 1.0);
}
