// A vertex of a ring grid between two skinned rings (plant_meshing.md, 6.3). What lies on a shared ring depends on that
// ring and on the vertex's own angle alone, so that neighbours agree to the bit.
#include "detail.glsl"
#ifdef EVALUATED
uvec4 cell;
uvec3 run;
#else
layout(location = 0) in uvec4 cell;  // place along, place around, pieces, level of the grid's sides
layout(location = 1) in uvec3 run;   // skinned rings; how it bends
#endif
layout(std430, binding = 6) readonly buffer Skinned { SkinnedRing skinned[]; };

struct Corner {
  vec3 position, normal;
  vec2 bark;  // around 0..1, along
  float radius;
  vec2 round;  // cosine and sine of the angle
  uint link, tint;
};

#ifdef WATCHED
// A polygon of few sides stands for a circle: what of its sides lies behind the silhouette gets the normal of the circle
// in front of it, mirrored in the plane that holds the axis and the silhouette. Else a twig of three sides would turn
// its light twice too fast and show dark edges.
vec3 seenNormal(vec3 radial, vec3 centre, vec3 tangent) {
  vec3 sight = centre - eye.xyz;
  vec3 away = sight - tangent * dot(sight, tangent);
  float square = dot(away, away), behind = max(dot(radial, away), 0.0);
  float share = smoothstep(0.02, 0.15, square / max(dot(sight, sight), 1e-12));  // along the axis there is no front
  return radial - away * (2.0 * share * behind / max(square, 1e-12));
}
#endif

Corner cornerOf(SkinnedRing ring) {
  uint sides = uint(ceil(ring.level));
  uint around = cell.y >> (cell.w - min(sides, cell.w));
  uint whole = 3u << sides;
  float step = 6.28318531 / float(whole);
  uint place = around == whole ? 0u : around;
  precise float angle = (float(place) - float(place & 1u) * slide(ring.level)) * step;
  Corner corner;
  corner.round = vec2(cos(angle), sin(angle));
  vec3 side = cross(ring.along.xyz, ring.across.xyz);
  precise vec3 radial = ring.across.xyz * corner.round.x + side * corner.round.y;
  float radius = ring.place.w;
  // Roots run out from a flaring trunk.
  if (ring.reach < 0.0) radius *= 1.0 - ring.reach * cos(5.0 * angle + 0.7);
  precise vec3 position = ring.place.xyz + radial * radius;
  corner.position = position;
  vec3 facing = radial;
#ifdef WATCHED
  facing = seenNormal(radial, ring.place.xyz, ring.along.xyz);
#endif
  corner.normal = normalize(facing - ring.along.xyz * ring.across.w);
  // Towards the parent's surface at a collar, by the distance from it (4.1).
  float height = ring.outwards.w + max(ring.reach, 0.0) * dot(radial, ring.outwards.xyz);
  float blend = 1.0 - clamp(height, 0.0, 1.0);
  vec3 blended = mix(corner.normal, ring.outwards.xyz, blend * blend);
  if (dot(blended, blended) > 1e-6) corner.normal = normalize(blended);
  float turn = around == whole ? 1.0 : angle / 6.28318531;
  corner.bark = vec2(turn, -ring.along.w);  // up the stem is up the picture
  corner.radius = ring.place.w;
  corner.link = ring.link;
  corner.tint = ring.tint;
  return corner;
}

Corner corner() {
  SkinnedRing ring = skinned[cell.x == 0u ? run.x : run.y];
#ifndef STRAIGHT
  if (cell.x != 0u && cell.x != cell.z) {
    SkinnedRing a = skinned[run.x];
    float t = float(cell.x) / float(cell.z), s = 1.0 - t;
    float chord = distance(a.place.xyz, ring.place.xyz);
    // Cubic Hermite with the curve's own speeds.
    vec3 m0 = a.along.xyz * (chord * float((run.z >> 2u) & 0x7fffu) / 8192.0);
    vec3 m1 = ring.along.xyz * (chord * float(run.z >> 17u) / 8192.0);
    vec3 p = a.place.xyz * ((1.0 + 2.0 * t) * s * s) + m0 * (t * s * s) + ring.place.xyz * (t * t * (3.0 - 2.0 * t)) - m1 * (t * t * s);
    vec3 d = (ring.place.xyz - a.place.xyz) * (6.0 * t * s) + m0 * (s * (1.0 - 3.0 * t)) + m1 * (t * (3.0 * t - 2.0));
    vec3 tangent = normalize(d + a.along.xyz * 1e-12);
    vec3 across = mix(a.across.xyz, ring.across.xyz, t);
    across = normalize(across - tangent * dot(across, tangent));
    float thin = ring.place.w / max(a.place.w, 1e-9);
    // Bark runs as the integral over a linearly changing radius (5).
    float share = abs(thin - 1.0) < 1e-3 ? t : log(1.0 + t * (max(thin, 1e-3) - 1.0)) / log(max(thin, 1e-3));
    ring.place = vec4(p, mix(a.place.w, ring.place.w, t));
    ring.along = vec4(tangent, mix(a.along.w, ring.along.w, share));
    ring.across = vec4(across, mix(a.across.w, ring.across.w, t));
    ring.outwards = mix(a.outwards, ring.outwards, t);
    ring.reach = mix(a.reach, ring.reach, t);
    ring.level = mix(a.level, ring.level, t);
  }
#endif
  return cornerOf(ring);
}
