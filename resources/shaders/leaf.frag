#include "frame.glsl"
#include "surface.glsl"
#include "leaf_layers.glsl"
layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;
layout(location = 2) in vec3 layerUv;
layout(location = 3) flat in vec4 ageAndTint;
layout(location = 4) in vec3 around;
layout(location = 5) in vec3 behind;
layout(location = 6) in vec4 air;
layout(location = 7) in vec3 worldTangent;
layout(location = 8) flat in float level;
layout(location = 0) out vec4 color;
layout(binding = 3) uniform sampler2DArray leafMaps;
layout(binding = 4) uniform sampler2DArray surfaceMaps;
layout(binding = 5) uniform sampler2DArray ageingMaps;

// The pigments of a place: model's agedTexture, by factors on linear light instead of steps in Lab.
vec3 aged(vec3 albedo, vec4 field, float sharp, uint layer) {
  if (ageAndTint.x <= 0.0 && ageAndTint.z <= 0.0) return albedo;
  vec2 run = -0.35 + 1.7 * ageAndTint.xz;
  float green = 1.0 / (1.0 + exp((run.x - field.r) / (0.07 * sharp)));
  float dead = 1.0 / (1.0 + exp((field.g - run.y) / (0.05 * sharp)));
  float red = min(1.0, ageAndTint.y * layers[layer].shape.z * field.b * 1.82) * (1.0 - green);
  // Factors mix in their logarithm, as steps of lightness do.
  vec3 gain = mix(vec3(0.0), log(layers[layer].gains[0].rgb), 1.0 - green);
  gain = mix(gain, log(layers[layer].gains[1].rgb), red);
  gain = mix(gain, log(layers[layer].gains[2].rgb), dead);
  return min(albedo * exp(gain), vec3(0.9));
}

void main() {
  vec4 texel = texture(leafMaps, layerUv);
  // Where a few texels are all that is left of a leaf, their alpha is the share of the pixel that it covers; a limit at
  // one half would let narrow leaves vanish and broad ones fill their picture.
  float blur = blurred(textureQueryLod(leafMaps, layerUv.xy).x, textureQueryLevels(leafMaps));
  float alpha = mix(sharpened(texel.a), texel.a, blur);
  gl_SampleMask[0] = -1;
  if (blur > 0.0) {
    // Devices round alpha to samples each in its own way; here by a threshold of the pixel and the leaf, so that
    // the mean is right and leaves behind one another do not fail at the same pixels.
    float noise = fract(gradientNoise(gl_FragCoord.xy) + 43.7 * ageAndTint.w);
    uint samples = uint(4.0 * alpha + noise), turn = uint(4.0 * fract(7.0 * noise));
    uint mask = (1u << samples) - 1u;
    gl_SampleMask[0] = int(((mask << turn) | (mask >> (4u - turn))) & 15u);
    if (samples == 0u) discard;
    alpha = 1.0;
  }
  if (alpha <= 0.0) discard;
  uint layer = uint(layerUv.z + 0.5);
  vec3 albedo = texel.rgb / max(texel.a, 1e-3);
  // Near leaves have a surface; far ones the mean of it.
  vec4 surface = vec4(0.5, 0.5, 0.52, 0.85), field = vec4(0.42, 0.5, 0.55, 0.95);
  vec3 normal = normalize(worldNormal);
  bool near = level < 1.5;
  if (near) {
    surface = texture(surfaceMaps, layerUv);
    field = texture(ageingMaps, layerUv);
    vec2 slope = surface.xy * 2.0 - 1.0;
    vec3 tangent = normalize(worldTangent - normal * dot(worldTangent, normal));
    normal = normalize(tangent * slope.x + cross(normal, tangent) * slope.y +
                       normal * sqrt(max(0.05, 1.0 - dot(slope, slope))));
  }
  albedo = aged(albedo, field, near ? 1.0 : 3.0, layer);
  // A leaf's own shade: lighter or darker, and a little towards red or yellow.
  float tint = ageAndTint.w;
  albedo *= (1.0 + 0.22 * tint) * vec3(1.0, 1.0 + 0.16 * tint, 1.0 + 0.1 * tint);
  vec3 view = normalize(eye.xyz - worldPosition);
  bool front = dot(worldNormal, view) >= 0.0;
  float roughness = min(1.0, surface.b + 0.25 * ageAndTint.z);
  if (!front) {
    // A thin sheet: what is a groove above is a ridge below. The lower face is paler and duller.
    normal = -normal;
    albedo = mix(albedo, vec3(dot(albedo, vec3(0.33))), 0.2) * 1.08;
    roughness = min(1.0, roughness + 0.15);
  }
  vec3 open = front ? around : behind, other = front ? behind : around;
  float facing = dot(normal, toSun.xyz);
  vec3 sun = sunColor.rgb * sunVisibility(worldPosition, normalize(worldNormal) * sign(dot(worldNormal, toSun.xyz)), 1.2);
  // Twice through the pigment: deeper and more saturated than what is reflected; less through veins and dead tissue.
  vec3 through = albedo * (0.35 + 0.9 * albedo) * 1.25 * surface.a * (1.0 - 0.55 * ageAndTint.z);
  vec3 light = sun / kPi * (albedo * max(facing, 0.0) + through * max(-facing, 0.0));
  light += sun * specular(normal, view, roughness) * (front ? 0.75 : 0.4);
  light += (albedo * open + 0.45 * through * other) * field.a;
  color = vec4(mix(light, air.rgb, air.a), alpha);
}
