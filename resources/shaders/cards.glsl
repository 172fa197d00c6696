// Cards: clusters and boughs of leaves drawn as pictures of themselves.
struct CardNode {
  vec4 sphere;         // m, rest space of its tree
  vec4 spread;         // mean of n n^T of the blades: xx, yy, zz; mean blade length, m
  vec4 spreadAndArea;  // xy, xz, yz; squared lengths of the leaves in the picture, m2
  ivec4 place;         // link, bough (-1: it is one), first cluster, number of clusters
  uvec4 picture;       // first layer, layer of its first leaf
};
layout(std430, binding = 0) readonly buffer Bones { mat4 bones[]; };
layout(std430, binding = 4) readonly buffer CardNodes { CardNode cardNodes[]; };
layout(std430, binding = 5) readonly buffer CardInstances { uvec2 cardInstances[]; };  // node, first link of its tree

mat4 cardPose(uvec2 card, CardNode node) { return bones[card.y + uint(node.place.x)]; }
