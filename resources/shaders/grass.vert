#include "frame.glsl"
#include "meadow.glsl"
// Tufts of grass on three square rings before the camera, each of cells twice as wide as the last; anchored in the
// world, so that they stay where they are when the camera moves. A blade is one triangle.
layout(location = 0) centroid out vec3 light;  // a sliver would extrapolate

const int kBlades = 5;

uint hashed(uint value) {
  uint state = value * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}
float unit(inout uint state) {
  state = hashed(state);
  return float(state >> 8u) / 16777216.0;
}

float cellSize(int ring) { return 0.13 * exp2(float(ring)); }

// Lower corner of a ring in whole cells.
ivec2 ringCorner(int ring, int cells) {
  float size = cellSize(ring);
  vec2 ahead = normalize(forward.xz + vec2(1e-5));
  // Where the lower edge of the picture meets the ground, or the foot of a camera that looks down.
  vec2 center = eye.xz + ahead * size * float(cells) * 0.42;
  return ivec2(floor(center / size)) - cells / 2;
}

void main() {
  int cells = int(grass.y);
  int ring = gl_InstanceID / (cells * cells);
  int index = gl_InstanceID - ring * cells * cells;
  ivec2 cell = ringCorner(ring, cells) + ivec2(index % cells, index / cells);
  float size = cellSize(ring);
  uint state = hashed(uint(cell.x) * 2654435761u ^ hashed(uint(cell.y) ^ (uint(ring) << 20u)));
  vec2 place = (vec2(cell) + vec2(unit(state), unit(state))) * size;

  light = vec3(0.0);
  gl_Position = vec4(0.0, 0.0, -1.0, 1.0);
  if (ring > 0) {
    float inner = cellSize(ring - 1);
    vec2 corner = vec2(ringCorner(ring - 1, cells)) * inner;
    if (all(greaterThan(place, corner)) && all(lessThan(place, corner + float(cells) * inner))) return;
  }
  vec4 clip = viewProjection * vec4(place.x, 0.0, place.y, 1.0);
  if (clip.w < 0.2 || abs(clip.x) > clip.w * 1.05 + 0.3 || abs(clip.y) > clip.w * 1.05 + 0.3) return;

  Meadow meadow = meadowAt(place);
  int blade = gl_VertexID / 3, corner = gl_VertexID % 3;
  state += uint(blade) * 977u;
  float turn = unit(state) * 6.2831853, lean = unit(state), tall = unit(state);
  vec2 side = vec2(cos(turn), sin(turn));
  // Tufts stand higher here and there; the last ring runs out softly.
  float far = length(place - eye.xz) / (cellSize(2) * float(cells) * 0.86);
  float height = grass.x * (0.35 + 1.1 * tall * smoothstep(0.25, 0.8, meadow.tufts.r)) * (1.0 - meadow.earth) *
                 smoothstep(1.0, 0.75, far) * (1.0 + 0.35 * float(ring));
  if (height < 0.006) return;
  vec2 root = place + (vec2(unit(state), unit(state)) - 0.5) * size;
  float width = 0.0075 * (1.0 + 0.75 * float(ring)) * (0.7 + 0.6 * lean);
  vec2 push = wind.xz * 0.006 * (1.0 + 0.6 * sin(eye.w * 2.6 + dot(place, vec2(1.7, 1.3)) + lean));
  vec3 position = vec3(root.x, 0.0, root.y);
  if (corner == 2) {
    position += vec3(0.0, height, 0.0);
    position.xz += (vec2(-side.y, side.x) * (0.2 + 0.7 * lean) + push * 2.0) * height;
  } else {
    position.xz += side * width * (corner == 0 ? -1.0 : 1.0);
  }

  vec3 albedo = meadow.albedo * mix(0.8, 1.5, unit(state)) * vec3(0.92, 1.12, 0.8);
  albedo = mix(albedo, vec3(0.26, 0.20, 0.07), step(0.86, lean) * 0.6);
  vec3 normal = normalize(vec3(-side.y * 0.5, 1.0, side.x * 0.5));
  vec3 view = normalize(eye.xyz - position);
  float against = pow(max(dot(-view, toSun.xyz), 0.0), 3.0);
  float visible = sunVisibility(vec3(place.x, 0.03, place.y), vec3(0.0, 1.0, 0.0), 2.2);
  float tip = corner == 2 ? 1.45 : 0.6;
  float direct = max(dot(normal, toSun.xyz), 0.0) + 0.7 * against * float(corner == 2);
  vec3 shown = albedo * tip * (sunColor.rgb / kPi * direct * visible +
                               ambientLight(normal) * canopyOpenness(vec3(place.x, 0.0, place.y), vec3(0.0, 1.0, 0.0)));
  vec4 air = airBefore(position);
  light = mix(shown, air.rgb, air.a);
  gl_Position = viewProjection * vec4(position, 1.0);
}
