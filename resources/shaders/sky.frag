#include "frame.glsl"
layout(location = 0) in vec3 ray;
layout(location = 0) out vec4 color;

// A row of wooded hills: its height above the horizon (sine of the elevation) at an azimuth in turns.
float hillHeight(float azimuth, float frequency, float offset) {
  float broad = textureLod(noiseMap, vec2(azimuth * frequency, offset), 2.0).r - 0.5;
  float woods = textureLod(noiseMap, vec2(azimuth * frequency * 14.0, offset + 0.37), 0.0).r - 0.5;
  return broad + 0.13 * woods;
}

void main() {
  vec3 direction = normalize(ray);
  vec3 light = skyRadiance(direction);
  float mu = dot(direction, toSun.xyz);

  // Clouds: a thin sheet, seen flatter towards the horizon.
  if (direction.y > 0.01) {
    vec2 place = direction.xz / (direction.y + 0.14) * 0.05 + wind.xz * eye.w * 2e-5 + vec2(0.31, 0.07);
    float mass = texture(noiseMap, place * vec2(0.8, 1.5)).r;
    vec4 wisps = texture(noiseMap, place * vec2(3.3, 4.6) + mass * 0.15);
    float body = mass * 0.68 + wisps.r * 0.3 + wisps.g * 0.07;
    float density = smoothstep(0.50, 0.80, body) * smoothstep(0.0, 0.16, direction.y);
    // Thin rims scatter the sun forwards, thick middles keep it.
    float forwards = pow(max(mu, 0.0), 5.0);
    vec3 lit = sunColor.rgb * (0.095 + 0.12 * forwards) * (1.0 - 0.35 * density) + ambient[0].rgb * 0.9;
    light = mix(light, lit, density * 0.85);
  }

  // The sun and its glow.
  float away = max(1.0 - mu, 0.0);
  light += sunColor.rgb * (smoothstep(2.4e-5, 1.4e-5, away) * 6.0 + 0.06 * exp(-away * 260.0) + 0.018 * exp(-away * 30.0));

  // Hills close the ground off: three rows, each deeper in the haze; woods stand on the nearest.
  if (direction.y < 0.1) {
    float azimuth = atan(direction.x, direction.z) / (2.0 * kPi);
    vec3 haze = skyRadiance(vec3(direction.x, 0.02, direction.z));
    float edge = max(fwidth(direction.y), 4e-4);
    for (int row = 2; row >= 0; --row) {
      float far = float(row);
      float height = 0.012 + 0.011 * far + (0.026 + 0.012 * far) * hillHeight(azimuth, 6.0 - far, 0.17 + 0.29 * far);
      float inside = smoothstep(edge, -edge, direction.y - height);
      float woods = textureLod(noiseMap, vec2(azimuth * 60.0, direction.y * 14.0 + far * 0.3), 0.5).r;
      vec3 albedo = mix(vec3(0.035, 0.04, 0.014), vec3(0.17, 0.085, 0.022), smoothstep(0.35, 0.75, woods));
      vec3 lit = albedo * (sunColor.rgb * 0.16 + ambient[0].rgb * 1.2);
      light = mix(light, mix(haze, lit, row == 0 ? 0.62 : row == 1 ? 0.36 : 0.2), inside);
    }
    light = mix(light, haze, 0.5 * smoothstep(0.010, -0.004, direction.y));
  }
  color = vec4(light, 1.0);
}
