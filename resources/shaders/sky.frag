#include "frame.glsl"
layout(location = 0) in vec3 ray;
layout(location = 0) out vec4 color;

// A row of wooded hills: its height above the horizon (sine of the elevation) at an azimuth in turns.
float hillHeight(float azimuth, float frequency, float offset) {
  float broad = textureLod(noiseMap, vec2(azimuth * frequency, offset), 2.0).r - 0.5;
  float woods = textureLod(noiseMap, vec2(azimuth * frequency * 10.0, offset + 0.37), 0.0).r - 0.5;
  return broad + 0.09 * woods;
}

void main() {
  vec3 direction = normalize(ray);
  vec3 light = skyRadiance(direction);
  float mu = dot(direction, toSun.xyz);

  // Clouds: a thin sheet, seen flatter towards the horizon.
  if (direction.y > 0.01) {
    vec2 place = direction.xz / (direction.y + 0.16) * 0.055 + wind.xz * eye.w * 2e-5;
    float mass = texture(noiseMap, place * vec2(1.0, 1.6)).r;
    float wisps = texture(noiseMap, place * vec2(4.1, 5.3) + mass * 0.12).r;
    float density = smoothstep(0.46, 0.92, mass * 0.72 + wisps * 0.42) * smoothstep(0.02, 0.22, direction.y);
    vec3 lit = sunColor.rgb * (0.055 + 0.10 * pow(max(mu, 0.0), 6.0)) + ambient[0].rgb * 0.7;
    light = mix(light, lit, density * 0.8);
  }

  // The sun and its glow.
  float away = max(1.0 - mu, 0.0);
  light += sunColor.rgb * (smoothstep(2.4e-5, 1.4e-5, away) * 6.0 + 0.06 * exp(-away * 260.0) + 0.018 * exp(-away * 30.0));

  // Hills close the ground off: three rows, each deeper in the haze.
  if (direction.y < 0.1) {
    float azimuth = atan(direction.x, direction.z) / (2.0 * kPi);
    vec3 haze = skyRadiance(vec3(direction.x, 0.02, direction.z));
    for (int row = 2; row >= 0; --row) {
      float nearness = 1.0 - float(row) / 3.0;
      float top = 0.030 - 0.007 * (2.0 - float(row)) + (0.030 + 0.006 * row) * hillHeight(azimuth, 5.0 - row, 0.17 + 0.29 * row);
      float edge = max(fwidth(direction.y), 4e-4);
      float inside = smoothstep(edge, -edge, direction.y - top);
      float woods = textureLod(noiseMap, vec2(azimuth * 40.0, direction.y * 9.0 + row * 0.3), 1.0).r;
      vec3 albedo = mix(vec3(0.10, 0.085, 0.03), vec3(0.21, 0.11, 0.03), woods);
      vec3 lit = albedo * (sunColor.rgb * 0.14 + ambient[0].rgb);
      light = mix(light, mix(haze, lit, 0.16 + 0.24 * nearness * nearness), inside);
    }
    light = mix(light, haze, smoothstep(0.012, -0.004, direction.y));
  }
  color = vec4(light, 1.0);
}
