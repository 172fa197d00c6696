#include "leaf.glsl"
layout(location = 0) uniform mat4 lightMatrix;
layout(location = 0) out vec3 layerUv;

void main() {
  LeafPoint point = leafPoint();
  layerUv = vec3(corner, float(point.layer));
  gl_Position = lightMatrix * vec4(point.position, 1.0);
}
