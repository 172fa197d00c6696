// A card: a square that looks to the eye (SHADOW: to the sun), with the pictures taken from the nearest directions.
#include "frame.glsl"
#include "cards.glsl"
#include "card_views.glsl"
#include "leaf_layers.glsl"
layout(location = 0) in uvec4 listed;
layout(location = 0) uniform mat4 lightMatrix;
layout(location = 1) uniform float season;
layout(location = 2) uniform vec4 scale;  // pixels a radian, px of a picture
layout(location = 8) uniform vec3 views[10];
layout(location = 0) out vec3 worldPosition;
layout(location = 1) out vec4 corners;    // places in the first two pictures
layout(location = 2) out vec2 corner;     // in the third
layout(location = 3) flat out vec4 pictures;  // three layers, level of detail
layout(location = 4) flat out vec4 chances;   // cuts between the pictures, dither from and to
layout(location = 5) flat out vec3 outward;   // to the eye, m
layout(location = 6) flat out vec4 turn0;     // rest space to world, by columns; w: light that comes through
layout(location = 7) flat out vec4 turn1;     // w: root of the mean square of the cosine between blades and sun
layout(location = 8) flat out vec4 turn2;     // w: share of the light around that reaches them
layout(location = 9) flat out vec4 air;
layout(location = 10) flat out vec2 own;  // a number of its own, share of brown leaves
layout(location = 11) flat out vec3 shares;  // of the leaves in the pictures, by their number and by how they lie

// Root of the mean square of the cosine between the blades' normals and a direction, both at rest.
float spreadAlong(CardNode node, vec3 d) {
  return sqrt(max(dot(node.spread.xyz, d * d) + 2.0 * dot(node.spreadAndArea.xyz, d.xxy * d.yzz), 1e-4));
}

vec2 placeIn(vec3 view, vec3 direction, vec3 offset) {
  vec3 right, up;
  cardAxes(view, right, up);
  // The shortest turn from the direction to the view's.
  float along = dot(direction, view);
  vec3 axis = cross(direction, view);
  vec3 moved = offset * along + cross(axis, offset) + axis * (dot(axis, offset) / max(1.0 + along, 1e-3));
  return vec2(dot(moved, right), -dot(moved, up)) * 0.5 + 0.5;
}

void main() {
  uvec2 card = cardInstances[listed.x];
  CardNode node = cardNodes[card.x];
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
#ifndef SHADOW
  if (listed.w == 0u) return;
#endif
  mat4 pose = cardPose(card, node);
  vec3 center = (pose * vec4(node.sphere.xyz, 1.0)).xyz;
  float radius = node.sphere.w;
#ifdef SHADOW
  vec3 toEye = toSun.xyz;
  float level = log2(max(scale.y / max(2.0 * radius * scale.x, 0.5), 1.0));
#else
  float away = max(length(eye.xyz - center), 0.05);
  vec3 toEye = (eye.xyz - center) / away;
  float level = log2(max(scale.y * away / max(2.0 * radius * scale.x, 1e-3), 1.0));
#endif
  mat3 turn = mat3(pose);
  vec3 direction = normalize(transpose(turn) * toEye);

  // The three nearest views; between them pixels are drawn by lot.
  uvec3 chosen = uvec3(0u);
  vec3 cosines = vec3(-2.0);
  for (uint i = 0u; i < 10u; ++i) {
    float c = dot(views[i], direction);
    if (c > cosines.x) {
      cosines = vec3(c, cosines.xy);
      chosen = uvec3(i, chosen.xy);
    } else if (c > cosines.y) {
      cosines.yz = vec2(c, cosines.y);
      chosen.yz = uvec2(i, chosen.y);
    } else if (c > cosines.z) {
      cosines.z = c;
      chosen.z = i;
    }
  }
  vec3 weights = exp(24.0 * (cosines - cosines.x));
  weights /= weights.x + weights.y + weights.z;

  vec3 right, up;
  cardAxes(direction, right, up);
  vec2 at = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vec3 offset = right * at.x + up * at.y;
  worldPosition = (pose * vec4(node.sphere.xyz + offset * radius, 1.0)).xyz;
  corners = vec4(placeIn(views[chosen.x], direction, offset), placeIn(views[chosen.y], direction, offset));
  corner = placeIn(views[chosen.z], direction, offset);
  pictures = vec4(vec3(chosen) + float(node.picture.x), level);
  chances = vec4(weights.x, weights.x + weights.y, unpackUnorm2x16(listed.y));
  outward = toEye * radius;
  // Leaves that lie flat show less of themselves from the side than in a picture from above, and the other way round.
  float here = spreadAlong(node, direction);
  vec3 there = vec3(spreadAlong(node, views[chosen.x]), spreadAlong(node, views[chosen.y]),
                    spreadAlong(node, views[chosen.z]));
  shares = uintBitsToFloat(listed.z) * clamp(here / there, 0.3, 3.0);
  own = vec2(fract(float(listed.x) * 0.61803399), 0.0);
#ifdef SHADOW
  gl_Position = lightMatrix * vec4(worldPosition, 1.0);
  // What a step of the radius to the sun takes off the depth.
  own.y = (lightMatrix * vec4(toSun.xyz * radius, 0.0)).z;
  turn0 = turn1 = turn2 = air = vec4(0.0);
#else
  turn1 = vec4(turn[1], spreadAlong(node, normalize(transpose(turn) * toSun.xyz)));
  air = airBefore(center);
  float now = clamp(season, 0.0, 1.0) * 16.0;
  uint low = uint(min(now, 15.0)), layer = min(node.picture.y, uint(layers.length()) - 1u);
  turn0 = vec4(turn[0], layers[layer].surface.a);
  turn2 = vec4(turn[2], canopyOpenness(center, vec3(0.0)) * layers[layer].field.a);
  own.y = mix(layers[layer].seasons[low].w, layers[layer].seasons[low + 1u].w, now - float(low));
  gl_Position = viewProjection * vec4(worldPosition, 1.0);
#endif
}
