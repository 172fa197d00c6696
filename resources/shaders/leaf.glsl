// A leaf's shape: a small grid, bent along the midrib and folded across it, placed by its instance.
layout(location = 0) in vec2 grid;           // x -1..1 across, y 0..1 up the picture
layout(location = 1) in vec4 placeAndSize;   // petiole's end, blade length in m
layout(location = 2) in vec4 rotation;       // unit quaternion x, y, z, w
layout(location = 3) in uvec2 layerAndState;
layout(location = 4) in vec2 curlAndTint;
layout(std430, binding = 2) readonly buffer Layers { vec4 layers[]; };  // pivot in shares of the picture, extent in blades

const uint kHidden = 4u;

vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

struct LeafPoint {
  vec3 position, normal;
  vec2 uv;
};

LeafPoint leafPoint() {
  uint layer = min(layerAndState.x, uint(layers.length()) - 1u);
  vec2 pivot = layers[layer].xy, extent = layers[layer].zw;
  float curl = clamp(curlAndTint.x, 0.0, 1.0);
  vec2 uv = vec2(grid.x * 0.5 + 0.5, 1.0 - grid.y);
  float x = (uv.x - pivot.x) * extent.x, y = (pivot.y - uv.y) * extent.y;
  // Fresh leaves droop towards the tip, dry ones curl up; no two alike (leaf_textures.md, 10).
  float curvature = mix(-0.45, 2.3, curl) * (1.0 + 0.5 * curlAndTint.y) + 0.02;
  float fold = (0.22 + 0.85 * curl) * (1.0 - 0.25 * curlAndTint.y);
  float angle = curvature * y;
  vec3 rib = vec3(0.0, sin(angle), 1.0 - cos(angle)) / curvature;
  vec3 ribNormal = vec3(0.0, -sin(angle), cos(angle));
  float tilt = fold * clamp(x / (0.5 * extent.x + 1e-4), -1.0, 1.0);
  vec3 local = rib + vec3(x * cos(fold), 0.0, 0.0) + ribNormal * abs(x) * sin(fold);
  vec3 localNormal = ribNormal * cos(tilt) - vec3(sin(tilt), 0.0, 0.0);
  LeafPoint point;
  point.position = placeAndSize.xyz + turned(rotation, local * placeAndSize.w);
  point.normal = turned(rotation, localNormal);
  point.uv = uv;
  return point;
}
