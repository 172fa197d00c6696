#include "frame.glsl"
layout(std430, binding = 2) readonly buffer Points { vec4 points[]; };
layout(location = 0) uniform int perStreak;
layout(location = 0) out vec2 look;  // -1..1 across, opacity

void main() {
  // Two triangles a segment, from point i to i + 1.
  int segment = gl_VertexID / 6;
  int corner = gl_VertexID % 6;
  int along = (corner == 1 || corner == 3 || corner == 4) ? 1 : 0;
  float side = (corner == 2 || corner == 4 || corner == 5) ? 1.0 : -1.0;
  int segments = perStreak - 1;
  int streak = segment / segments;
  int index = segment % segments;
  int first = streak * perStreak;
  int at = index + along;
  vec4 here = points[first + at];
  vec3 before = points[first + max(at - 1, 0)].xyz;
  vec3 after = points[first + min(at + 1, segments)].xyz;
  vec4 clip = viewProjection * vec4(here.xyz, 1.0);
  vec4 from = viewProjection * vec4(before, 1.0);
  vec4 to = viewProjection * vec4(after, 1.0);
  vec2 run = (from.xy / max(from.w, 0.05) - to.xy / max(to.w, 0.05)) * viewport.xy;
  float size = length(run);
  vec2 normal = size > 1e-4 ? vec2(-run.y, run.x) / size : vec2(0.0, 1.0);
  // The head is as wide as a finger, at least a pixel; the end thins out.
  float taper = 1.0 - float(at) / float(segments);
  float metres = 0.012 * (0.35 + 0.65 * taper);
  float wanted = metres * viewport.y / (2.0 * length(up.xyz) * max(clip.w, 0.05));
  float pixels = clamp(wanted, 0.7, 3.0);
  clip.xy += normal * side * pixels * 2.0 * viewport.zw * clip.w;
  look = vec2(side, here.w * taper * min(1.0, wanted / pixels + 0.35));
  gl_Position = clip;
}
