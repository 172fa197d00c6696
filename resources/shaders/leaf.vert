#include "frame.glsl"
#include "leaf.glsl"
layout(location = 0) out vec3 worldPosition;
layout(location = 1) out vec3 worldNormal;
layout(location = 2) out vec3 layerUv;
layout(location = 3) flat out vec4 ageAndTint;
layout(location = 4) out vec3 around;  // diffuse light on the upper face, and on the lower
layout(location = 5) out vec3 behind;
layout(location = 6) centroid out vec4 air;
layout(location = 7) out vec3 worldTangent;
layout(location = 8) flat out float level;
layout(location = 9) flat out float fade;

void main() {
  LeafPoint point = leafPoint();
  // Leaves lie on the grass, not under it.
  float lift = grass.x * 0.75 * (1.0 - smoothstep(0.0, 0.25, point.position.y));
  worldPosition = point.position + vec3(0.0, lift, 0.0);
  worldNormal = point.normal;
  worldTangent = point.tangent;
  layerUv = vec3(corner, float(point.layer));
  ageAndTint = vec4(point.age, point.tint);
  level = ribAndLevel.y;
  fade = point.fade;
  float open = canopyOpenness(worldPosition, worldNormal);
  around = ambientLight(worldNormal) * open;
  behind = ambientLight(-worldNormal) * open;
  air = airBefore(worldPosition);
  gl_Position = viewProjection * vec4(worldPosition, 1.0);
}
