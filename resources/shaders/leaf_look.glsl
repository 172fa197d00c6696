// What colour a leaf shows. Needs leaf_layers.glsl.

// The pigments of a place: model's agedTexture, by factors on linear light instead of steps in Lab.
vec3 aged(vec3 albedo, vec3 age, vec4 field, float sharp, uint layer) {
  if (age.x <= 0.0 && age.z <= 0.0) return albedo;
  vec2 run = -0.35 + 1.7 * age.xz;
  float green = 1.0 / (1.0 + exp((run.x - field.r) / (0.07 * sharp)));
  float dead = 1.0 / (1.0 + exp((field.g - run.y) / (0.05 * sharp)));
  float red = min(1.0, age.y * layers[layer].shape.z * field.b * 1.82) * (1.0 - green);
  // Factors mix in their logarithm, as steps of lightness do.
  vec3 gain = mix(vec3(0.0), log(layers[layer].gains[0].rgb), 1.0 - green);
  gain = mix(gain, log(layers[layer].gains[1].rgb), red);
  gain = mix(gain, log(layers[layer].gains[2].rgb), dead);
  return min(albedo * exp(gain), vec3(0.9));
}

// A leaf's own shade: lighter or darker, and a little towards red or yellow.
vec3 tinted(vec3 albedo, float tint) {
  return albedo * (1.0 + 0.22 * tint) * vec3(1.0, 1.0 + 0.16 * tint, 1.0 + 0.1 * tint);
}

// The lower face is paler.
vec3 fromBelow(vec3 albedo) { return mix(albedo, vec3(dot(albedo, vec3(0.33))), 0.2) * 1.08; }
