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

const uint kHidden = 4u;
const uint kAttached = 0u;
