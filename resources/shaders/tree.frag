#include "frame.glsl"
#include "surface.glsl"
#include "wood.glsl"
layout(location = 0) in vec3 worldPosition;
layout(location = 1) centroid in vec3 worldNormal;
layout(location = 2) in vec2 textureUv;
layout(location = 3) in vec3 restPosition;
layout(location = 4) in vec3 restNormal;
layout(location = 5) centroid in float highlight;
layout(location = 6) centroid in vec3 around;
layout(location = 7) centroid in vec3 behind;
layout(location = 8) centroid in vec4 air;
layout(location = 9) in float barkRepeats;
layout(location = 10) centroid in vec4 barkTint;
layout(location = 11) centroid in vec4 dataColor;
layout(location = 0) out vec4 color;
#ifdef LAYERED
// Many plants in one draw call: a layer each.
layout(location = 12) flat in uint layer;
layout(location = 13) centroid in float twig;
layout(binding = 3) uniform sampler2DArray pictures;
// From the vertex shader: pixels beside a triangle, which derivatives need, may read nothing from a buffer.
layout(location = 14) flat in vec4 baseColor;
layout(location = 15) flat in vec4 look;
layout(location = 16) flat in vec3 twigColor;
layout(location = 17) flat in vec4 meanColor;
#define PICTURE(uv) pictures, vec3(uv, float(layer))
#else
layout(binding = 3) uniform sampler2D picture;
layout(location = 0) uniform vec4 baseColor;
layout(location = 1) uniform vec4 look;  // roughness, has a picture, 0, height of the bark's relief in m
#define PICTURE(uv) picture, uv
#endif
// Known when it is compiled, since software rasterizers fetch texels on both sides of a branch.
#if defined(PICTURED)
const bool pictured = true;
#elif defined(BARE)
const bool pictured = false;
#else
bool pictured = look.y > 0.5;
#endif

// A picture that repeats 2^k times round the stem; between two k it fades, so that no seam shows where the stem's
// radius halves. The fade loses contrast and gets it back (plant_meshing.md, 5).
vec4 barkPicture() {
  float k = floor(barkRepeats);
  float fade = smoothstep(0.3, 0.7, barkRepeats - k);
  vec2 dx = dFdx(textureUv), dy = dFdy(textureUv);
  float scale = exp2(k);
  vec4 coarse = textureGrad(PICTURE(textureUv * scale), dx * scale, dy * scale);
  if (fade <= 0.0) return coarse;
  vec4 fine = textureGrad(PICTURE(textureUv * scale * 2.0), dx * scale * 2.0, dy * scale * 2.0);
  if (fade >= 1.0) return fine;
#ifdef LAYERED
  vec4 mean = meanColor;
#else
  vec4 mean = textureLod(PICTURE(vec2(0.5)), 16.0);
#endif
  vec4 both = mix(coarse, fine, fade);
  return max(mean + (both - mean) / sqrt(fade * fade + (1.0 - fade) * (1.0 - fade)), vec4(0.0));
}

// Bark from noise, stretched along the trunk, laid on from the sides and from above: x is height, y lightness.
vec2 barkRelief(vec3 rest, vec3 normal) {
  vec2 sideways = abs(normal.xz);
  float share = smoothstep(0.35, 0.65, sideways.x / (sideways.x + sideways.y + 1e-4));
  vec4 a = texture(noiseMap, vec2(rest.x * 3.6, rest.y * 0.75));
  vec4 b = texture(noiseMap, vec2(rest.z * 3.6 + 0.4, rest.y * 0.75 + 0.2));
  vec4 both = mix(a, b, share);
  // Upper and lower sides of limbs would show the sideways pictures drawn out.
  float level = smoothstep(0.5, 0.85, abs(normal.y));
  if (level > 0.0) both = mix(both, texture(noiseMap, rest.xz * vec2(2.4, 2.4) + 0.7), level);
  return vec2(both.b * 0.65 + both.g * 0.35, both.r);
}

void main() {
  vec3 normal = normalize(worldNormal);
  vec3 view = normalize(eye.xyz - worldPosition);
#ifdef FOLIAGE
  vec4 texel = pictured ? texture(picture, textureUv) : vec4(1.0);
#else
  vec4 texel = pictured ? barkPicture() : vec4(1.0);
#endif
  vec3 albedo = baseColor.rgb * texel.rgb / max(texel.a, 1e-3);
  float alpha = 1.0;
#ifdef FOLIAGE
  alpha = sharpened(texel.a);
  if (alpha <= 0.0) discard;
  bool front = dot(normal, view) >= 0.0;
  normal = front ? normal : -normal;
  vec3 light = foliageLight(albedo, front ? around : behind, front ? behind : around, worldPosition, normal, view, look.x);
#else
#ifdef LAYERED
  albedo = woodAlbedo(albedo, texel.rgb, barkTint, dataColor, twigColor, twig);
#else
  albedo = woodAlbedo(albedo, texel.rgb, barkTint, dataColor, vec3(0.0), 0.0);
#endif
  vec3 smoothNormal = normal;
  vec2 bark = pictured ? vec2(dot(texel.rgb, vec3(0.33)), 0.5) : barkRelief(restPosition, restNormal);
  // Nearer than the noise is fine, its texels would show as facets.
  float pixel = length(dFdx(worldPosition)) + length(dFdy(worldPosition));
  normal = bumped(normal, worldPosition, bark.x * look.w * smoothstep(0.0004, 0.004, pixel));
  if (!pictured) albedo *= mix(0.28, 1.5, bark.x * bark.x) * mix(0.75, 1.2, bark.y);
  vec3 light = woodLight(albedo, around, worldPosition, normal, smoothNormal, view, look.x);
#endif
  light = accented(light, normal, view, highlight);
  color = vec4(mix(light, air.rgb, air.a), alpha);
}
