#include "frame.glsl"
layout(location = 0) in vec3 worldPosition;
layout(location = 0) out vec4 color;

void main() {
  vec2 place = worldPosition.xz;
  // Five scales; mip levels take each out before it could flicker.
  vec4 meadow = texture(noiseMap, place * 0.011);
  vec4 patches = texture(noiseMap, mat2(0.8, 0.6, -0.6, 0.8) * place * 0.067);
  vec4 tufts = texture(noiseMap, mat2(0.6, -0.8, 0.8, 0.6) * place * 0.29);
  vec4 blades = texture(noiseMap, place * vec2(1.3, 1.15));
  vec4 stalks = texture(noiseMap, mat2(0.96, 0.28, -0.28, 0.96) * place * vec2(4.3, 3.7));

  vec3 grass = mix(vec3(0.035, 0.060, 0.012), vec3(0.105, 0.105, 0.022), smoothstep(0.3, 0.7, meadow.r * 0.55 + patches.r * 0.5));
  vec3 straw = vec3(0.23, 0.165, 0.055);
  vec3 earth = vec3(0.075, 0.048, 0.027);
  vec3 albedo = mix(grass, straw, smoothstep(0.42, 0.85, patches.g * 0.45 + tufts.r * 0.6) * 0.6);
  albedo = mix(albedo, earth, smoothstep(0.60, 0.9, patches.b * 0.45 + (1.0 - tufts.r) * 0.55) * 0.55);
  // Stalks shade each other: dark gaps, light tips.
  float tips = 0.5 + (blades.r - 0.5) * 0.7 + (stalks.r - 0.5) * 0.8 + (stalks.g - 0.5) * 0.6 + (tufts.g - 0.5) * 0.5;
  albedo *= mix(0.35, 1.75, clamp(tips, 0.0, 1.0));

  vec2 tilt = (tufts.rg - 0.5) * 0.5 + (blades.rg - 0.5) * 0.7 + (stalks.rg - 0.5) * 0.8;
  vec3 normal = normalize(vec3(tilt.x, 1.0, tilt.y));
  float visible = sunVisibility(worldPosition, vec3(0.0, 1.0, 0.0), 2.2);
  float open = canopyOpenness(worldPosition, vec3(0.0, 1.0, 0.0));
  // Grass lets light through: bright against the sun.
  vec3 view = normalize(eye.xyz - worldPosition);
  float against = pow(max(dot(-view, toSun.xyz), 0.0), 3.0);
  float direct = max(dot(normal, toSun.xyz), 0.0) + 0.35 * against * tips;
  vec3 light = albedo / kPi * sunColor.rgb * direct * visible + albedo * ambientLight(normal) * open;
  vec4 air = airBefore(worldPosition);
  color = vec4(mix(light, air.rgb, air.a), 1.0);
}
