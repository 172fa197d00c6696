// What every leaf shader knows of instances and layers.
struct LeafInstance {
  vec4 placeAndSize;  // petiole's end, leaf length in m
  vec4 rotation;      // unit quaternion x, y, z, w
  uvec2 layerAndState;
  vec2 curlAndTint;
};
struct Layer {
  vec4 shape;        // stalk, half width, redness, wetness
  vec4 gains[3];     // yellow, red, brown; fourths: see blurOf
  vec4 seasons[17];  // shares of green, yellow, red, brown leaves
  vec4 surface;      // means of the maps over the leaf
  vec4 field;
  vec4 cover[12];    // of each level of the picture and shape: what alpha is multiplied by where it is a share
};
layout(std430, binding = 2) readonly buffer Layers { Layer layers[]; };
layout(std430, binding = 3) readonly buffer Leaves { LeafInstance leaves[]; };

// An entry of the sorted lists: the leaf's number, and above it how much larger it is drawn, in steps to four times.
const uint kIndexBits = 21u, kScaleSteps = 2046u;
const float kLargestScale = 4.0;

uint leafBits(uint value) {
  uint state = value * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

// From 0 to 1 as the level of detail of a picture falls from 8 x 8 to 4 x 4 texels; coverage is kept down to 8 x 8.
float blurred(float level, int levels) { return clamp(level - float(levels) + 4.0, 0.0, 1.0); }

// How far a layer's alpha is no shape any more but the share that is covered: where few texels are left of the picture,
// and where most of them are cut by edges, as of needles.
float blurOf(uint layer, float level, int levels) {
  float from = layers[layer].gains[0].w, to = layers[layer].gains[1].w;
  return max(blurred(level, levels), clamp((level - from) / max(to - from, 0.1), 0.0, 1.0));
}

// Such a share, so corrected that the shape of this level of detail covers what the leaf covers.
float coverOf(uint layer, float level, float shape, float alpha) {
  int low = clamp(int(level), 0, 10), of = clamp(int(shape + 0.5), 0, 3);
  return min(1.0, alpha * mix(layers[layer].cover[low][of], layers[layer].cover[low + 1][of], clamp(level - float(low), 0.0, 1.0)));
}

// Interleaved gradient noise (Jimenez 2014), 0..1.
float gradientNoise(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

// Samples of this pixel, of four, whose place in the dither lies from `low` to below `high`: what is drawn twice while one
// form gives way to the other shares out the samples between both.
int ditherMask(vec2 pixel, float low, float high) {
  float noise = gradientNoise(pixel);
  int mask = 0;
  for (int i = 0; i < 4; ++i) {
    float place = fract(noise + 0.25 * float(i));
    if (place >= low && place < high) mask |= 1 << i;
  }
  return mask;
}

// `count` of four samples, the first of them by a turn.
int sampleMask(uint count, uint turn) {
  uint mask = (1u << count) - 1u;
  return int(((mask << turn) | (mask >> (4u - turn))) & 15u);
}

const uint kHidden = 4u;
const uint kAttached = 0u, kResting = 3u;
