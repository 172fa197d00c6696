#include "frame.glsl"
#include "surface.glsl"
layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;
layout(location = 2) in vec3 layerUv;
layout(location = 3) flat in float tint;
layout(location = 4) in vec3 around;
layout(location = 5) in vec3 behind;
layout(location = 6) in vec4 air;
layout(location = 0) out vec4 color;
layout(binding = 3) uniform sampler2DArray leafMaps;

void main() {
  vec4 texel = texture(leafMaps, layerUv);
  float alpha = sharpened(texel.a);
  if (alpha <= 0.0) discard;
  vec3 albedo = texel.rgb / max(texel.a, 1e-3);
  // A leaf's own shade: lighter or darker, and a little towards red or yellow.
  albedo *= (1.0 + 0.22 * tint) * vec3(1.0, 1.0 + 0.16 * tint, 1.0 + 0.1 * tint);
  vec3 normal = normalize(worldNormal);
  vec3 view = normalize(eye.xyz - worldPosition);
  bool front = dot(normal, view) >= 0.0;
  if (!front) {
    normal = -normal;
    albedo = mix(albedo, vec3(dot(albedo, vec3(0.33))), 0.2) * 1.08;  // the lower face is paler
  }
  vec3 light = foliageLight(albedo, front ? around : behind, front ? behind : around, worldPosition, normal, view, 0.5);
  color = vec4(mix(light, air.rgb, air.a), alpha);
}
