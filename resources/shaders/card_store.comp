// From the samples of baked pictures to a level of their layers: means over whole texels, premultiplied.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 6) uniform sampler2DMS colours;
layout(binding = 7) uniform sampler2DMS surfaces;
layout(binding = 0, rgba8) writeonly uniform image2DArray toColours;
layout(binding = 1, rgba8) writeonly uniform image2DArray toSurfaces;
layout(location = 0) uniform ivec4 layout_;  // px of a picture, pictures in a row, level, first layer

vec3 encoded(vec3 linear) {
  return mix(linear * 12.92, 1.055 * pow(max(linear, 1e-6), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear));
}

void main() {
  int step_ = 1 << layout_.z, side = layout_.x / step_, picture = int(gl_GlobalInvocationID.z);
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (at.x >= side || at.y >= side) return;
  ivec2 from = ivec2(picture % layout_.y, picture / layout_.y) * layout_.x + at * step_;
  vec4 color = vec4(0.0), surface = vec4(0.0);
  for (int y = 0; y < step_; ++y) {
    for (int x = 0; x < step_; ++x) {
      for (int i = 0; i < 4; ++i) {
        color += texelFetch(colours, from + ivec2(x, y), i);
        surface += texelFetch(surfaces, from + ivec2(x, y), i);
      }
    }
  }
  float count = 4.0 * float(step_ * step_);
  ivec3 to = ivec3(at, layout_.w + picture);
  imageStore(toColours, to, vec4(encoded(min(color.rgb / count, 1.0)), color.a / count));
  imageStore(toSurfaces, to, surface / count);
}
