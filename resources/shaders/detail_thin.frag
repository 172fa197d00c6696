// Wood narrower than two pixels. Nothing of its bark can be seen but the mean, so the vertex shader finds the colour;
// what is left to each pixel is little, for thousands of twigs touch many pixels and fill none.
#define ONE_TAP
#include "frame.glsl"
#include "surface.glsl"
layout(location = 0) centroid in vec3 worldPosition;
layout(location = 1) centroid in vec3 worldNormal;
layout(location = 2) centroid in vec3 albedo;
layout(location = 3) centroid in vec3 around;
layout(location = 4) centroid in vec4 air;
layout(location = 5) centroid in vec2 shine;  // roughness, highlight
layout(location = 0) out vec4 color;

void main() {
  vec3 normal = normalize(worldNormal);
  vec3 view = normalize(eye.xyz - worldPosition);
  vec3 light = woodLight(albedo, around, worldPosition, normal, normal, view, shine.x);
  light = accented(light, normal, view, shine.y);
  color = vec4(mix(light, air.rgb, air.a), 1.0);
}
