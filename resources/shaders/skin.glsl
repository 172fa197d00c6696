// Skinning by any number of links: one matrix a link, rest space of its tree to world.
layout(std430, binding = 0) readonly buffer Bones { mat4 bones[]; };

mat4 skinMatrix(uint firstLink, uvec4 links, vec4 weights) {
  return bones[firstLink + links.x] * weights.x + bones[firstLink + links.y] * weights.y +
         bones[firstLink + links.z] * weights.z + bones[firstLink + links.w] * weights.w;
}
