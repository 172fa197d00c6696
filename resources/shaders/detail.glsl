// The adaptive mesh's arrays; layouts as in src/kernels/detail_data.h.
struct Ring {
  vec4 place;     // rest position, radius
  vec4 along;     // tangent, bark coordinate
  vec4 across;    // normal, slope of the radius
  vec4 outwards;  // away from the parent's axis; distance from its surface in lengths of the collar
  float reach;    // radius in lengths of the collar; negative: height of root lobes
  float collar;  // how near the junction
  uint link;
  uint tint;
};

struct SkinnedRing {
  vec4 place;  // world; radius widened to a circle's outline
  vec4 along;
  vec4 across;
  vec4 outwards;
  float level;  // log2(sides / 3)
  float reach;
  uint link;
  uint tint;
};

struct Entry {
  uint ringA, ringB, chain, shape;
  float sag, from, to, radius;
};

struct Chain {
  uint middle;
  float radius;
  uint firstEntry, entryCount;
};

struct Tree {
  uint firstRing, ringCount, firstEntry, entryCount;
  uint firstChain, chainCount, firstLink, firstSkinned;
  uint firstKey, layer, pad0, pad1;
  vec4 widening[3];
};

const uint kRadial = 5u, kAxial = 4u, kGrids = 20u;

float slide(float level) {
  float rest = ceil(level) - level;
  return rest * rest * rest * rest;
}
