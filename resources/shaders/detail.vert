#include "frame.glsl"
#include "detail_vertex.glsl"
layout(std430, binding = 1) readonly buffer Highlights { uint highlightBits[]; };
invariant gl_Position;

layout(location = 0) out vec3 worldPosition;
layout(location = 1) out vec3 worldNormal;
layout(location = 2) out vec2 textureUv;
layout(location = 3) out vec3 restPosition;
layout(location = 4) out vec3 restNormal;
layout(location = 5) out float highlight;
layout(location = 6) out vec3 around;
layout(location = 7) out vec3 behind;
layout(location = 8) out vec4 air;
layout(location = 9) out float barkRepeats;
layout(location = 10) out vec4 barkTint;
layout(location = 11) out vec4 dataColor;

void main() {
  Corner at = corner();
  worldPosition = at.position;
  worldNormal = at.normal;
  textureUv = at.bark;
  barkRepeats = 0.0;
  barkTint = unpackUnorm4x8(at.tint);
  dataColor = vec4(0.0);
  // Unrolled: the noise runs round and along every branch alike.
  restPosition = vec3(at.round.x, at.bark.y * 6.28318531, at.round.y) * 0.12;
  restNormal = vec3(at.round.x, 0.0, at.round.y);
  highlight = accent.w > 0.0 ? float((highlightBits[at.link >> 5u] >> (at.link & 31u)) & 1u) : 0.0;
  float open = canopyOpenness(worldPosition, worldNormal) * mix(0.55, 1.0, smoothstep(0.0, 0.9, worldPosition.y));
  around = ambientLight(worldNormal) * open;
  behind = around;
  air = airBefore(worldPosition);
  gl_Position = viewProjection * vec4(worldPosition, 1.0);
}
