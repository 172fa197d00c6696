#include "leaf.glsl"
layout(location = 0) uniform mat4 lightMatrix;
layout(location = 0) out vec3 layerUv;

void main() {
  LeafPoint point = leafPoint();
  layerUv = vec3(point.uv, float(layerAndState.x));
  gl_Position = layerAndState.y == kHidden ? vec4(0.0, 0.0, 2.0, 1.0) : lightMatrix * vec4(point.position, 1.0);
}
