// How wood and leaves answer to light. Needs frame.glsl.

// Alpha with an edge of one pixel at one half, for alpha to coverage (Golus 2017).
float sharpened(float alpha) {
  return clamp((alpha - 0.5) / max(fwidth(alpha), 1e-4) + 0.5, 0.0, 1.0);
}

// A height in metres tilts the normal by its change over the screen (Mikkelsen 2010, unparametrized surfaces).
vec3 bumped(vec3 normal, vec3 position, float height) {
  vec3 dx = dFdx(position), dy = dFdy(position);
  vec3 r1 = cross(dy, normal), r2 = cross(normal, dx);
  float det = dot(dx, r1);
  vec3 gradient = sign(det) * (dFdx(height) * r1 + dFdy(height) * r2);
  vec3 tilted = abs(det) * normal - gradient;
  return dot(tilted, tilted) > 0.0 ? normalize(mix(normal, normalize(tilted), 0.8)) : normal;
}

// GGX with Schlick's Fresnel and a joint visibility term, times pi-free irradiance.
float specular(vec3 normal, vec3 view, float roughness) {
  vec3 middle = normalize(view + toSun.xyz);
  float a = roughness * roughness, a2 = a * a;
  float nh = max(dot(normal, middle), 0.0), nl = max(dot(normal, toSun.xyz), 0.0), nv = max(dot(normal, view), 0.05);
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float fresnel = 0.04 + 0.96 * pow(1.0 - max(dot(view, middle), 0.0), 5.0);
  return a2 / (kPi * d * d) * fresnel * 0.25 / max(mix(nl, 1.0, a) * mix(nv, 1.0, a), 0.05) * nl;
}

// Chosen links: the accent over the surface, brighter towards the silhouette.
vec3 accented(vec3 light, vec3 normal, vec3 view, float chosen) {
  // A product, since a power of what rounding leaves below zero is no number.
  float edge = 1.0 - abs(dot(normal, view)), rim = edge * edge;
  return mix(light, accent.rgb * (0.55 * dot(light, vec3(0.33)) + 0.35 + 1.1 * rim), chosen * accent.w);
}

// `around` is the diffuse light from sky and ground on that side, less what crowns hold back.
vec3 woodLight(vec3 albedo, vec3 around, vec3 position, vec3 normal, vec3 smoothNormal, vec3 view, float roughness) {
  vec3 sun = sunColor.rgb * sunVisibility(position, smoothNormal, 1.2);
  return albedo / kPi * sun * max(dot(normal, toSun.xyz), 0.0) + sun * specular(normal, view, roughness) + albedo * around;
}

// `normal` looks to the viewer's side. Light from the other side comes through, in a fuller colour.
vec3 foliageLight(vec3 albedo, vec3 around, vec3 behind, vec3 position, vec3 normal, vec3 view, float roughness) {
  float facing = dot(normal, toSun.xyz);
  vec3 sun = sunColor.rgb * sunVisibility(position, normal * sign(facing), 1.2);
  // Twice through the pigment: deeper and more saturated than what is reflected.
  vec3 through = albedo * (0.35 + 0.9 * albedo) * 1.25;
  vec3 light = sun / kPi * (albedo * max(facing, 0.0) + through * max(-facing, 0.0));
  light += sun * specular(normal, view, roughness) * 0.6;
  return light + albedo * around + 0.45 * through * behind;
}
