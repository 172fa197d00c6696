// What every leaf shader knows of instances and layers.
struct LeafInstance {
  vec4 placeAndSize;  // petiole's end, leaf length in m
  vec4 rotation;      // unit quaternion x, y, z, w
  uvec2 layerAndState;
  vec2 curlAndTint;
};
struct Layer {
  vec4 shape;        // stalk, half width, redness, wetness
  vec4 gains[3];     // yellow, red, brown
  vec4 seasons[17];  // shares of green, yellow, red, brown leaves
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

// Interleaved gradient noise (Jimenez 2014), 0..1.
float gradientNoise(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

const uint kHidden = 4u;
const uint kAttached = 0u, kResting = 3u;
