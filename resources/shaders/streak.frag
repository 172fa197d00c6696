#include "frame.glsl"
layout(location = 0) in vec2 look;
layout(location = 0) out vec4 color;

void main() {
  vec3 light = max(ambientLight(vec3(0.0, 1.0, 0.0)) / kPi, vec3(0.0)) + sunColor.rgb * (0.25 / kPi);
  float edge = 1.0 - look.x * look.x;
  color = vec4(light * 1.15, 0.55 * look.y * edge);
}
