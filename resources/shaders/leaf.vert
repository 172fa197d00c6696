#include "frame.glsl"
#include "leaf.glsl"
layout(location = 0) out vec3 worldPosition;
layout(location = 1) out vec3 worldNormal;
layout(location = 2) out vec3 layerUv;
layout(location = 3) flat out float tint;
layout(location = 4) out vec3 around;  // diffuse light on the upper face, and on the lower
layout(location = 5) out vec3 behind;
layout(location = 6) out vec4 air;

void main() {
  LeafPoint point = leafPoint();
  // Leaves lie on the grass, not under it.
  float lift = grass.x * 0.75 * (1.0 - smoothstep(0.0, 0.25, point.position.y));
  worldPosition = point.position + vec3(0.0, lift, 0.0);
  worldNormal = point.normal;
  layerUv = vec3(point.uv, float(layerAndState.x));
  tint = curlAndTint.y;
  float open = canopyOpenness(worldPosition, worldNormal);
  around = ambientLight(worldNormal) * open;
  behind = ambientLight(-worldNormal) * open;
  air = airBefore(worldPosition);
  gl_Position = layerAndState.y == kHidden ? vec4(0.0, 0.0, -1.0, 1.0) : viewProjection * vec4(worldPosition, 1.0);
}
