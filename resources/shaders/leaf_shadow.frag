layout(location = 0) in vec3 layerUv;
layout(binding = 3) uniform sampler2DArray leafMaps;

void main() {
  if (texture(leafMaps, layerUv).a < 0.5) discard;
}
