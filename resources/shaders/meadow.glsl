// What the meadow looks like from above; ground and grass share it. Needs frame.glsl.

struct Meadow {
  vec3 albedo;
  float earth;  // share of bare earth
  vec4 tufts;
};

// Three scales; mip levels take each out before it could flicker.
Meadow meadowAt(vec2 place) {
  vec4 broad = texture(noiseMap, place * 0.011);
  vec4 patches = texture(noiseMap, mat2(0.8, 0.6, -0.6, 0.8) * place * 0.067);
  Meadow meadow;
  meadow.tufts = texture(noiseMap, mat2(0.6, -0.8, 0.8, 0.6) * place * 0.29);
  vec3 grass = mix(vec3(0.030, 0.053, 0.011), vec3(0.075, 0.078, 0.016), smoothstep(0.3, 0.7, broad.r * 0.55 + patches.r * 0.5));
  vec3 straw = vec3(0.165, 0.115, 0.036);
  vec3 earth = vec3(0.075, 0.048, 0.027);
  meadow.earth = smoothstep(0.60, 0.9, patches.b * 0.45 + (1.0 - meadow.tufts.r) * 0.55) * 0.55;
  meadow.albedo = mix(grass, straw, smoothstep(0.42, 0.85, patches.g * 0.45 + meadow.tufts.r * 0.6) * 0.6);
  meadow.albedo = mix(meadow.albedo, earth, meadow.earth);
  return meadow;
}
