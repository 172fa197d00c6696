#include "leaf.glsl"
layout(location = 0) uniform mat4 lightMatrix;
layout(location = 0) out vec3 layerUv;
layout(location = 1) flat out vec2 fadeAndLevel;

void main() {
  LeafPoint point = leafPoint();
  fadeAndLevel = vec2(point.fade, ribAndLevel.y);
  layerUv = vec3(corner, float(point.layer));
  gl_Position = lightMatrix * vec4(point.position, 1.0);
}
