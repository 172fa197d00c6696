#include "frame.glsl"
#include "surface.glsl"
#include "leaf_layers.glsl"
layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec4 corners;
layout(location = 2) in vec2 corner;
layout(location = 3) flat in vec4 pictures;
layout(location = 4) flat in vec4 chances;
layout(location = 5) flat in vec3 outward;
layout(location = 6) flat in vec4 turn0;
layout(location = 7) flat in vec4 turn1;
layout(location = 8) flat in vec4 turn2;
layout(location = 9) flat in vec4 air;
layout(location = 10) flat in vec2 own;
layout(location = 11) flat in vec3 shares;
layout(binding = 3) uniform sampler2DArray cardColours;   // premultiplied
layout(binding = 4) uniform sampler2DArray cardSurfaces;  // normal and depth, premultiplied

#ifndef SHADOW
layout(location = 0) out vec4 color;
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  // A lot of each card's own, beside the dither that leaves and cards share.
  float lot = fract(texelFetch(noiseMap, (pixel + ivec2(61.0 * own.x, 97.0 * own.x)) & 511, 0).a + own.x);
  float view = fract(gradientNoise(gl_FragCoord.xy + vec2(5.0, 17.0)) + 3.0 * own.x);
  vec3 at = view < chances.x   ? vec3(corners.xy, pictures.x)
            : view < chances.y ? vec3(corners.zw, pictures.y)
                               : vec3(corner, pictures.z);
  float share = view < chances.x ? shares.x : view < chances.y ? shares.y : shares.z;
  vec4 texel = textureLod(cardColours, at, pictures.w);
  if (texel.a < 0.004) discard;
  // Where leaves have come off: what is left by chance of so many behind one another.
  float wide = clamp(textureLod(cardColours, at, pictures.w + 2.0).a, 0.02, 0.97);
  float alpha = texel.a * (1.0 - pow(1.0 - wide, share)) / wide;
  vec4 surface = textureLod(cardSurfaces, at, pictures.w) / texel.a;
  float depth = surface.w * 2.0 - 1.0;
#ifdef SHADOW
  float place = gradientNoise(gl_FragCoord.xy);
  if (alpha <= max(lot, 1e-3) || place < chances.z || place >= chances.w + (chances.w > 0.9999 ? 1.0 : 0.0)) discard;
  gl_FragDepth = gl_FragCoord.z + own.y * depth;
#else
  uint samples = uint(min(4.0 * alpha + lot, 4.0)), turn = uint(4.0 * fract(7.0 * lot));
  int mask = sampleMask(samples, turn) &
             ditherMask(gl_FragCoord.xy, chances.z, chances.w + (chances.w > 0.9999 ? 1.0 : 0.0));
  if (mask == 0) discard;
  gl_SampleMask[0] = mask;
  vec3 albedo = texel.rgb / texel.a;
  vec3 position = worldPosition + outward * depth;
  vec4 clip = viewProjection * vec4(position, 1.0);
  gl_FragDepth = clip.z / clip.w;

  // Many blades: the mean of their normals, and how far these are alike.
  vec3 mean = mat3(turn0.xyz, turn1.xyz, turn2.xyz) * (surface.xyz * 2.0 - 1.0);
  float alike = min(length(mean), 1.0), facing = dot(mean, toSun.xyz);
  float either = max(mix(0.87 * turn1.w, abs(facing) / max(alike, 1e-3), smoothstep(0.6, 1.0, alike)), abs(facing));
  vec3 normal = mean / max(alike, 1e-3), toEye = normalize(outward);
  vec3 sun = sunColor.rgb * sunVisibility(position, normal * sign(facing), 1.2);
  vec3 through = albedo * (0.35 + 0.9 * albedo) * 1.25 * turn0.w * (1.0 - 0.55 * own.y);
  vec3 light = sun / kPi * (albedo * 0.5 * (either + facing) + through * 0.5 * (either - facing));
  light += sun * specular(normal, toEye, mix(0.9, 0.6, smoothstep(0.6, 1.0, alike))) * 0.6;
  light += (albedo * ambientLight(mean) + 0.45 * through * ambientLight(-mean)) * turn2.w;
  color = vec4(mix(light, air.rgb, air.a), 1.0);
#endif
}
