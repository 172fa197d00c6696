#include "frame.glsl"
layout(location = 0) out vec3 ray;

void main() {
  // One triangle over the whole picture, at the far plane (depth 0).
  vec2 corner = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID & 2) * 2 - 1);
  ray = forward.xyz + right.xyz * corner.x + up.xyz * corner.y;
  gl_Position = vec4(corner, 0.0, 1.0);
}
