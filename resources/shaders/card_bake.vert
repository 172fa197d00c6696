// A leaf in a cluster's picture.
#include "leaf.glsl"
#include "card_views.glsl"
layout(location = 4) in uint tile;
struct CardTile {
  vec4 sphere;     // m
  vec4 direction;  // of the view, out of the picture
  vec4 frame;      // middle and half size in the target, -1..1
};
layout(std430, binding = 8) readonly buffer CardTiles { CardTile cardTiles[]; };
layout(location = 0) out vec3 layerUv;
layout(location = 1) flat out vec4 ageAndTint;
layout(location = 2) out vec3 restNormal;
layout(location = 3) out float depth;
layout(location = 4) flat out vec3 direction;

void main() {
  LeafPoint point = leafPoint();
  CardTile to = cardTiles[tile];
  vec3 right, up;
  direction = to.direction.xyz;
  cardAxes(direction, right, up);
  vec3 offset = (point.position - to.sphere.xyz) / to.sphere.w;
  layerUv = vec3(corner, float(point.layer));
  ageAndTint = vec4(point.age, point.tint);
  restNormal = point.normal;
  depth = clamp(dot(offset, direction) * 0.5 + 0.5, 0.0, 1.0);
  // Rows from the top: up is down the target. No leaf reaches into another's picture.
  vec2 place = clamp(vec2(dot(offset, right), -dot(offset, up)), -0.999, 0.999);
  gl_Position = vec4(to.frame.xy + place * to.frame.zw, depth, 1.0);
}
