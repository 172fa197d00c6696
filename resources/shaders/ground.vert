#include "frame.glsl"
layout(location = 0) out vec3 worldPosition;

void main() {
  vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID & 2) - 1);
  worldPosition = vec3(eye.x + corner.x * 1500.0, 0.0, eye.z + corner.y * 1500.0);
  gl_Position = viewProjection * vec4(worldPosition, 1.0);
}
