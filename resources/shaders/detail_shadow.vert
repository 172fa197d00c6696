#include "detail_vertex.glsl"
layout(location = 0) uniform mat4 lightMatrix;

void main() { gl_Position = lightMatrix * vec4(corner().position, 1.0); }
