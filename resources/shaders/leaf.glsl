// A leaf's shape: its own mesh, bent along the midrib and folded across it, placed by its instance; and its age.
#include "leaf_layers.glsl"
layout(location = 0) in vec2 place;      // leaf lengths from the petiole's end
layout(location = 1) in vec2 ribAndLevel;
layout(location = 2) in vec2 corner;     // shares of the picture
layout(location = 3) in uint listed;
layout(location = 1) uniform float season;
#ifndef BAKE
#include "leaf_cards.glsl"
#endif

vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

uint leafIndex = listed & ((1u << kIndexBits) - 1u);

struct LeafPoint {
  vec3 position, normal, tangent;
  vec3 age;  // fading, reddening, browning
  float tint;
  uint layer, state;
  float fade;  // how far a card has taken its place
};

// Model's ageOfRank: the leaf's place among all by how early it turns.
vec3 ageOf(uint layer, LeafInstance leaf) {
  float at = clamp(season, 0.0, 1.0) * 16.0;
  uint low = uint(min(at, 15.0));
  vec4 shares = mix(layers[layer].seasons[low], layers[layer].seasons[low + 1u], at - float(low));
#ifdef BAKE
  uint number = leaf.layerAndState.y, state = kAttached;
#else
  uint number = leafIndex, state = leaf.layerAndState.y;
#endif
  float rank = float(leafBits(number) >> 8u) / 16777216.0;
  // What has come off is what had turned.
  if (state != kAttached) rank = mix(rank, 1.0, 0.35);
  vec3 limit = vec3(shares.x, shares.x + shares.y, shares.x + shares.y + shares.z);
  vec3 t = clamp((rank - limit) / vec3(0.2, 0.2, 0.3) + 1.0 - limit, 0.0, 1.0);
  t = t * t * (3.0 - 2.0 * t);
  if (shares.z + shares.w < 1e-6) t.y = 0.0;
  return t;
}

// Model's bendOf and bend (leaf_bend.cpp).
LeafPoint leafPoint() {
  LeafInstance leaf = leaves[leafIndex];
#ifdef BAKE
  // Its own share of dryness stands there (leaf_look.h).
  leaf.curlAndTint.x = clamp(0.1 + 0.5 * season * season + 0.3 * (leaf.curlAndTint.x - 0.5), 0.0, 1.0);
#endif
  LeafPoint point;
  point.layer = min(leaf.layerAndState.x, uint(layers.length()) - 1u);
#ifdef BAKE
  point.state = kAttached;
  point.fade = 0.0;
#else
  point.state = leaf.layerAndState.y;
  point.fade = cardFade(leafIndex, point.state);
#endif
  point.tint = leaf.curlAndTint.y;
  point.age = ageOf(point.layer, leaf);
  vec4 shape = layers[point.layer].shape;
  float aged = (0.15 * point.age.x + 0.85 * point.age.z) * (1.25 - 0.6 * shape.w);
  float dry = clamp(max(leaf.curlAndTint.x, 0.85 * aged), 0.0, 1.0), own = point.tint;
  float curvature = (-0.45 + 2.75 * dry) * (1.0 + 0.5 * own);
  if (abs(curvature) < 1e-4) curvature = 1e-4;
  float fold = (0.16 + 0.55 * dry) * (1.0 - 0.25 * own), roll = 0.10 + 0.70 * dry * (1.0 + 0.3 * own);
  float stalk = shape.x, halfWidth = max(shape.y, 1e-3), rib = ribAndLevel.x;
  float angle = curvature * max(0.0, place.y - stalk);
  vec3 outwards = vec3(0.0, -sin(angle), cos(angle));
  vec3 middle = vec3(place.x - rib, min(place.y, stalk) + sin(angle) / curvature, (1.0 - cos(angle)) / curvature);
  float turn = max(1e-4, roll / halfWidth), side = rib < 0.0 ? -1.0 : 1.0, far = abs(rib), slope = fold + turn * far;
  float across = (sin(slope) - sin(fold)) / turn, up = (cos(fold) - cos(slope)) / turn;
  float outer = min(1.0, far / halfWidth);
  float wave = (0.006 + 0.03 * dry) * outer * outer * sin(21.0 * place.y + 2.0 * side + 6.0 * own);
  vec3 local = middle + vec3(side * across, 0.0, 0.0) + outwards * (up + wave);
  float tilt = side * (slope - fold * max(0.0, 1.0 - far / (0.12 * halfWidth + 1e-4)));
  // Those that are left stand for those that were left out.
  float size = leaf.placeAndSize.w * float(listed >> kIndexBits) * (kLargestScale / float(kScaleSteps));
  point.position = leaf.placeAndSize.xyz + turned(leaf.rotation, local * size);
  point.normal = turned(leaf.rotation, outwards * cos(tilt) - vec3(sin(tilt), 0.0, 0.0));
  point.tangent = turned(leaf.rotation, outwards * sin(tilt) + vec3(cos(tilt), 0.0, 0.0));
  return point;
}
