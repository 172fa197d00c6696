// Counts the runs of each grid.
#include "detail_select.glsl"

void main() {
  Tree tree = trees[gl_GlobalInvocationID.y];
  uint index = gl_GlobalInvocationID.x;
  if (index >= tree.entryCount) return;
  Entry entry = entries[tree.firstEntry + index];
  Chain chain = chains[tree.firstChain + entry.chain];
  uint key = kGrids;
  vec3 centre = skinned[tree.firstSkinned + chain.middle].place.xyz;
  float centre2 = square(centre - camera.xyz);
  if (!outsideSphere(centre, chain.radius) && reaches(centre2, chain.radius, entry.from) &&
      !reaches(centre2, chain.radius, entry.to)) {
    int grid = gridOf(entry, skinned[tree.firstSkinned + entry.ringA].place.xyz, rings[tree.firstRing + entry.ringA].place.w,
                      skinned[tree.firstSkinned + entry.ringB].place.xyz, rings[tree.firstRing + entry.ringB].place.w);
    if (grid >= 0) {
      key = uint(grid);
      atomicAdd(commands[5u * key + 1u], 1u);
    }
  }
  keys[tree.firstKey + index] = key;
}
