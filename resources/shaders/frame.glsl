// What every shader of a frame shares. Radiance in the sky model's units; world space in metres, Y up.
layout(std140, binding = 0) uniform Frame {
  mat4 viewProjection;
  mat4 shadowMatrix;     // world to shadow map: uv and depth in 0..1
  vec4 eye;              // xyz, time in s
  vec4 toSun;            // unit vector, exposure factor
  vec4 sunColor;         // irradiance, world size of a shadow texel
  vec4 ambient[4];       // diffuse light: constant, and along x, y, z
  vec4 forward;          // view ray = forward + right * ndc.x + up * ndc.y
  vec4 right;
  vec4 up;
  vec4 wind;             // m/s, number of canopies
  vec4 viewport;         // size, its inverse
  vec4 accent;           // of highlighted links, linear; its strength
  vec4 grass;            // height of the grass in m (0: none), number of cells along a ring's side
  vec4 canopies[32];     // two for each: centre and 1, radii (xz, y, height of the lowest leaves)
};
layout(binding = 0) uniform sampler2D noiseMap;
layout(binding = 1) uniform sampler2D skyMap;
layout(binding = 2) uniform sampler2DShadow shadowMap;

const float kPi = 3.14159265;

vec3 skyRadiance(vec3 direction) {
  vec2 flatDirection = normalize(direction.xz + vec2(1e-6));
  vec2 flatSun = normalize(toSun.xz + vec2(1e-6));
  float halfAzimuth = sqrt(clamp(0.5 - 0.5 * dot(flatDirection, flatSun), 0.0, 1.0));
  float root = sqrt(max(direction.y, 0.0));
  return texture(skyMap, vec2(halfAzimuth, root) * (63.0 / 64.0) + 0.5 / 64.0).rgb;
}

vec3 ambientLight(vec3 normal) {
  return max(ambient[0].rgb + ambient[1].rgb * normal.x + ambient[2].rgb * normal.y + ambient[3].rgb * normal.z, 0.0);
}

// Share of the sky that the crowns leave open at a point, for a surface that looks to `normal`.
float canopyOpenness(vec3 position, vec3 normal) {
  float open = 1.0;
  for (int i = 0; i < int(wind.w); ++i) {
    vec3 center = canopies[2 * i].xyz;
    vec3 radii = canopies[2 * i + 1].xyz;
    vec3 offset = (center - position) / vec3(radii.x, radii.y, radii.x);
    float distance2 = dot(offset, offset);
    // Inside, light fades with the depth below the crown's surface; outside, with the solid angle that it fills.
    float inside = clamp(1.0 - distance2, 0.0, 1.0) * 0.55;
    float facing = 0.5 + 0.5 * dot(normal, offset) * inversesqrt(distance2 + 1e-3);
    float outside = 0.5 * facing / (1.0 + 1.3 * distance2);
    open *= 1.0 - mix(outside, max(inside, outside * 0.6), step(distance2, 1.0));
  }
  return open;
}

// Share of the sun that reaches a point; the point is moved off its surface by about a texel against self-shadowing.
float sunVisibility(vec3 position, vec3 normal, float softness) {
  float slope = 1.0 - abs(dot(normal, toSun.xyz));
  vec3 moved = position + normal * (sunColor.w * (0.6 + 1.6 * slope)) + toSun.xyz * (sunColor.w * 0.8);
  vec3 at = (shadowMatrix * vec4(moved, 1.0)).xyz;
  if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 1.0;
  vec2 texel = softness / vec2(textureSize(shadowMap, 0));
#ifdef HIGH_QUALITY
  float lit = 0.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      // A tent: the middle counts four times as much as the corners.
      float weight = (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0);
      lit += weight * texture(shadowMap, vec3(at.xy + vec2(x, y) * texel, at.z));
    }
  }
  lit /= 16.0;
#elif defined(ONE_TAP)
  float lit = texture(shadowMap, at);
#else
  float lit = 0.25 * (texture(shadowMap, vec3(at.xy + vec2(-0.6, -0.25) * texel, at.z)) +
                      texture(shadowMap, vec3(at.xy + vec2(0.25, -0.6) * texel, at.z)) +
                      texture(shadowMap, vec3(at.xy + vec2(0.6, 0.25) * texel, at.z)) +
                      texture(shadowMap, vec3(at.xy + vec2(-0.25, 0.6) * texel, at.z)));
#endif
  // The map's rim fades, so that no square lies on the ground.
  vec2 rim = smoothstep(vec2(0.0), vec2(0.06), min(at.xy, 1.0 - at.xy));
  return mix(1.0, lit, rim.x * rim.y);
}

// Air between the eye and a point: the horizon's light of that direction, and in w how much of it there is.
vec4 airBefore(vec3 position) {
  vec3 ray = position - eye.xyz;
  float distance = length(ray);
  float share = 1.0 - exp(-distance * 0.0008 - distance * distance * 1.2e-6);
  vec3 direction = ray / max(distance, 1e-3);
  return vec4(skyRadiance(vec3(direction.x, 0.02, direction.z)), share);
}
