// What colour wood has where its bark's picture shows `texel`, before light. Needs frame.glsl.
//
// `tint`: on the colour; alpha: how much is wood. `data`: instead of bark where alpha says so. `twig`: how much of it is
// too thin for bark.
vec3 woodAlbedo(vec3 albedo, vec3 texel, vec4 tint, vec4 data, vec3 twigColor, float twig) {
  // Where there is no wood yet, a green skin with what is left of the bark's grain.
  float grain = dot(texel, vec3(0.33));
  albedo = mix(vec3(0.13, 0.20, 0.045) * (0.7 + 0.9 * grain), albedo, tint.a) * tint.rgb;
  // As light as the relief leaves it on a mean.
  albedo = mix(albedo, twigColor * 0.65, twig);
  // The colours of the legend, with a hint of the relief.
  vec3 shown = pow(max(data.rgb, vec3(0.0)), vec3(2.2)) * (0.75 + 0.5 * grain);
  return mix(albedo, shown, min(data.a, 1.0));
}
