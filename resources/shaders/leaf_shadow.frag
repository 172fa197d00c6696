#include "leaf_layers.glsl"
layout(location = 0) in vec3 layerUv;
layout(binding = 3) uniform sampler2DArray leafMaps;

void main() {
  float blur = blurred(textureQueryLod(leafMaps, layerUv.xy).x, textureQueryLevels(leafMaps));
  // A share of the light passes where the mean alpha is all that is left of the shape.
  float noise = gradientNoise(gl_FragCoord.xy);
  if (texture(leafMaps, layerUv).a < mix(0.5, max(noise, 1e-3), blur)) discard;
}
