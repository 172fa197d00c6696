#include "leaf_layers.glsl"
layout(location = 0) in vec3 layerUv;
layout(location = 1) flat in vec2 fadeAndLevel;
layout(binding = 3) uniform sampler2DArray leafMaps;

void main() {
  uint layer = uint(layerUv.z + 0.5);
  float level = textureQueryLod(leafMaps, layerUv.xy).x;
  float blur = blurOf(layer, level, textureQueryLevels(leafMaps));
  // A share of the light passes where the mean alpha is all that is left of the shape.
  float noise = gradientNoise(gl_FragCoord.xy);
  if (noise < fadeAndLevel.x) discard;
  float alpha = texture(leafMaps, layerUv).a;
  alpha = mix(alpha, coverOf(layer, level, fadeAndLevel.y, alpha), blur);
  if (alpha < mix(0.5, max(noise, 1e-3), blur)) discard;
}
