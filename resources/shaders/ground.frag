#include "frame.glsl"
#include "meadow.glsl"
layout(location = 0) in vec3 worldPosition;
layout(location = 0) out vec4 color;

void main() {
  vec2 place = worldPosition.xz;
  Meadow meadow = meadowAt(place);
  vec4 tufts = meadow.tufts;
  vec4 blades = texture(noiseMap, place * vec2(1.3, 1.15));
  vec4 stalks = texture(noiseMap, mat2(0.96, 0.28, -0.28, 0.96) * place * vec2(4.3, 3.7));
  vec3 albedo = meadow.albedo;
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
