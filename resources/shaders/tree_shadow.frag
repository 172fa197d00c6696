layout(location = 0) in vec2 textureUv;
layout(binding = 3) uniform sampler2D picture;
layout(location = 1) uniform float tested;  // 1: the picture's alpha cuts

void main() {
  if (tested > 0.5 && texture(picture, textureUv).a < 0.5) discard;
}
