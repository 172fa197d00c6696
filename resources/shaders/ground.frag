#include "frame.glsl"
layout(location = 0) in vec3 worldPosition;
layout(location = 0) out vec4 color;

void main() {
  vec2 place = worldPosition.xz;
  // Four scales; mip levels take each out before it could flicker.
  vec4 meadow = texture(noiseMap, place * 0.013);
  vec4 patches = texture(noiseMap, mat2(0.8, 0.6, -0.6, 0.8) * place * 0.071);
  vec4 tufts = texture(noiseMap, mat2(0.6, -0.8, 0.8, 0.6) * place * 0.31);
  vec4 blades = texture(noiseMap, place * vec2(1.9, 1.6));

  vec3 grass = mix(vec3(0.085, 0.115, 0.022), vec3(0.21, 0.19, 0.045), smoothstep(0.25, 0.75, meadow.r * 0.6 + patches.r * 0.5));
  vec3 straw = vec3(0.36, 0.27, 0.095);
  vec3 earth = vec3(0.115, 0.075, 0.042);
  vec3 albedo = mix(grass, straw, smoothstep(0.45, 0.85, patches.g * 0.5 + tufts.r * 0.55) * 0.55);
  albedo = mix(albedo, earth, smoothstep(0.62, 0.88, patches.b * 0.5 + (1.0 - tufts.r) * 0.5) * 0.6);
  // Stalks shade each other: dark gaps, light tips.
  float tips = blades.g * 0.6 + blades.r * 0.4 + (tufts.g - 0.5) * 0.5;
  albedo *= mix(0.55, 1.5, clamp(tips, 0.0, 1.0));

  vec2 tilt = (tufts.rg - 0.5) * 0.5 + (blades.rg - 0.5) * 0.7;
  vec3 normal = normalize(vec3(tilt.x, 1.0, tilt.y));
  float visible = sunVisibility(worldPosition, vec3(0.0, 1.0, 0.0), 2.2);
  float open = canopyOpenness(worldPosition, vec3(0.0, 1.0, 0.0));
  // Grass lets light through: bright against the sun.
  vec3 view = normalize(eye.xyz - worldPosition);
  float against = pow(max(dot(-view, toSun.xyz), 0.0), 3.0);
  float direct = max(dot(normal, toSun.xyz), 0.0) + 0.35 * against * tips;
  vec3 light = albedo / kPi * sunColor.rgb * direct * visible + albedo * ambientLight(normal) * open;
  color = vec4(throughAir(light, worldPosition), 1.0);
}
