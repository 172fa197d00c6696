#include "leaf_layers.glsl"
#include "leaf_look.glsl"
layout(location = 0) in vec3 layerUv;
layout(location = 1) flat in vec4 ageAndTint;
layout(location = 2) in vec3 restNormal;
layout(location = 3) in float depth;
layout(location = 4) flat in vec3 direction;
layout(location = 0) out vec4 color;
layout(location = 1) out vec4 surface;
layout(binding = 3) uniform sampler2DArray leafMaps;

void main() {
  vec4 texel = texture(leafMaps, layerUv);
  uint layer = uint(layerUv.z + 0.5);
  float level = textureQueryLod(leafMaps, layerUv.xy).x;
  float blur = blurOf(layer, level, textureQueryLevels(leafMaps));
  float noise = fract(gradientNoise(gl_FragCoord.xy) + 43.7 * ageAndTint.w);
  float alpha = mix(clamp((texel.a - 0.5) / max(fwidth(texel.a), 1e-4) + 0.5, 0.0, 1.0), coverOf(layer, level, 2.0, texel.a), blur);
  uint samples = uint(min(4.0 * alpha + noise, 4.0));
  gl_SampleMask[0] = sampleMask(samples, uint(4.0 * fract(7.0 * noise)));
  if (samples == 0u) discard;
  vec3 albedo = aged(texel.rgb / max(texel.a, 1e-3), ageAndTint.xyz, layers[layer].field, 3.0, layer);
  albedo = tinted(albedo, ageAndTint.w);
  vec3 normal = normalize(restNormal);
  if (dot(normal, direction) < 0.0) {
    normal = -normal;
    albedo = fromBelow(albedo);
  }
  color = vec4(albedo, 1.0);
  surface = vec4(normal * 0.5 + 0.5, depth);
}
