#include "frame.glsl"
#include "surface.glsl"
#include "leaf_layers.glsl"
layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;
layout(location = 2) in vec3 layerUv;
layout(location = 3) flat in vec4 ageAndTint;
layout(location = 4) in vec3 around;
layout(location = 5) in vec3 behind;
layout(location = 6) centroid in vec4 air;
layout(location = 7) in vec3 worldTangent;
layout(location = 8) flat in float level;
layout(location = 9) flat in float fade;
layout(location = 0) out vec4 color;
layout(binding = 3) uniform sampler2DArray leafMaps;
layout(binding = 4) uniform sampler2DArray surfaceMaps;
layout(binding = 5) uniform sampler2DArray ageingMaps;

#include "leaf_look.glsl"

void main() {
  vec4 texel = texture(leafMaps, layerUv);
  // Where a few texels are all that is left of a leaf, their alpha is the share of the pixel that it covers; a limit at
  // one half would let narrow leaves vanish and broad ones fill their picture.
  uint layer = uint(layerUv.z + 0.5);
  float blurLevel = textureQueryLod(leafMaps, layerUv.xy).x;
  float blur = blurOf(layer, blurLevel, textureQueryLevels(leafMaps));
  float alpha = sharpened(texel.a);
  if (blur > 0.0) alpha = mix(alpha, coverOf(layer, blurLevel, level, texel.a), blur);
  gl_SampleMask[0] = -1;
  if (blur > 0.0) {
    // Devices round alpha to samples each in its own way; here by a threshold of the pixel and the leaf, so that
    // the mean is right and leaves behind one another do not fail at the same pixels.
    float noise = fract(gradientNoise(gl_FragCoord.xy) + 43.7 * ageAndTint.w);
    uint samples = uint(4.0 * alpha + noise), turn = uint(4.0 * fract(7.0 * noise));
    gl_SampleMask[0] = sampleMask(samples, turn);
    if (samples == 0u) discard;
    alpha = 1.0;
  }
  if (fade > 0.0) gl_SampleMask[0] &= ditherMask(gl_FragCoord.xy, fade, 2.0);
  if (alpha <= 0.0) discard;
  vec3 albedo = texel.rgb / max(texel.a, 1e-3);
  // Near leaves have a surface; far ones the mean of it.
  vec4 surface = layers[layer].surface, field = layers[layer].field;
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
  albedo = tinted(aged(albedo, ageAndTint.xyz, field, near ? 1.0 : 3.0, layer), ageAndTint.w);
  vec3 view = normalize(eye.xyz - worldPosition);
  bool front = dot(worldNormal, view) >= 0.0;
  float roughness = min(1.0, surface.b + 0.25 * ageAndTint.z);
  if (!front) {
    // A thin sheet: what is a groove above is a ridge below. The lower face is paler and duller.
    normal = -normal;
    albedo = fromBelow(albedo);
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
