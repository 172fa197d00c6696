#include "frame.glsl"
#include "leaf.glsl"
layout(location = 0) out vec3 worldPosition;
layout(location = 1) out vec3 worldNormal;
layout(location = 2) out vec3 layerUv;
layout(location = 3) flat out float tint;

void main() {
  LeafPoint point = leafPoint();
  worldPosition = point.position;
  worldNormal = point.normal;
  layerUv = vec3(point.uv, float(layerAndState.x));
  tint = curlAndTint.y;
  gl_Position = layerAndState.y == kHidden ? vec4(0.0, 0.0, -1.0, 1.0) : viewProjection * vec4(worldPosition, 1.0);
}
