// Writes the list of runs, grid by grid.
#include "detail_select.glsl"

void main() {
  Tree tree = trees[gl_GlobalInvocationID.y];
  uint index = gl_GlobalInvocationID.x;
  if (index >= tree.entryCount) return;
  uint key = keys[tree.firstKey + index];
  if (key >= kGrids) return;
  Entry entry = entries[tree.firstEntry + index];
  runs[atomicAdd(cursors[key], 1u)] = uvec2(entry.ringA, entry.ringB) + tree.firstSkinned;
}
