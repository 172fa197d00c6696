#include "frame.glsl"
layout(location = 0) out vec4 color;
layout(binding = 3) uniform sampler2DMS picture;
layout(location = 0) uniform int side;           // px of the screen that a pixel of the picture spans
layout(location = 1) uniform ivec4 quarters;     // where it spans two: the sample that lies in each quarter

// AgX (Sobotka 2023) in the polynomial form of Wrensch: highlights lose colour as film does, hues stay.
vec3 agx(vec3 value) {
  const mat3 inset = mat3(0.842479062253094, 0.0423282422610123, 0.0423756549057051, 0.0784335999999992,
                          0.878468636469772, 0.0784336, 0.0792237451477643, 0.0791661274605434, 0.879142973793104);
  const float low = -12.47393, high = 4.026069;
  value = clamp((log2(max(inset * value, 1e-10)) - low) / (high - low), 0.0, 1.0);
  vec3 x2 = value * value, x4 = x2 * x2;
  return 15.5 * x4 * x2 - 40.14 * x4 * value + 31.96 * x4 - 6.868 * x2 * value + 0.4298 * x2 + 0.1191 * value - 0.00232;
}

vec3 graded(vec3 value) {
  const mat3 outset = mat3(1.19687900512017, -0.0528968517574562, -0.0529716355144438, -0.0980208811401368,
                           1.15190312990417, -0.0980434501171241, -0.0990297440797205, -0.0989611768448433,
                           1.15107367264116);
  value = pow(max(value, 0.0) * vec3(1.015, 1.0, 0.965), vec3(1.45));
  float grey = dot(value, vec3(0.2126, 0.7152, 0.0722));
  return outset * (grey + 1.38 * (value - grey));
}

void main() {
  ivec2 place = ivec2(gl_FragCoord.xy), pixel = place / side;
  // A coarse picture's samples have edges twice as fine as its pixels.
  int own = side == 2 ? quarters[(place.x & 1) + 2 * (place.y & 1)] : -1;
  // Samples are weighted by what they come to on the screen: a bright one does not eat its neighbours' edge.
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int i = 0; i < SAMPLES; ++i) {
    vec3 value = texelFetch(picture, pixel, i).rgb * toSun.w;
    float weight = (own < 0 || i == own ? 1.0 : 0.25) / (1.0 + max(value.r, max(value.g, value.b)));
    sum += value * weight;
    weights += weight;
  }
  vec3 shown = graded(agx(sum / weights));
  // Triangular noise of one step against bands.
  vec2 noise = vec2(texelFetch(noiseMap, place & 511, 0).a, texelFetch(noiseMap, (place + ivec2(173, 71)) & 511, 0).a);
  color = vec4(clamp(shown + (noise.x - noise.y) / 255.0, 0.0, 1.0), 1.0);
}
