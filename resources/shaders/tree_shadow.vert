#include "skin.glsl"
#ifdef PIECES
#include "pieces.glsl"
layout(location = 1) in vec3 normal;
#endif
layout(location = 0) in vec3 position;
layout(location = 2) in vec2 uv;
layout(location = 3) in uvec4 links;
layout(location = 4) in vec4 weights;
layout(location = 5) in uint firstLink;
layout(location = 0) uniform mat4 lightMatrix;
layout(location = 0) out vec2 textureUv;

void main() {
  textureUv = uv;
  vec3 place = position;
#ifdef PIECES
  place += normal * pieceWidening(firstLink);
#endif
  gl_Position = lightMatrix * skinMatrix(firstLink, links, weights) * vec4(place, 1.0);
}
