// Writes the list of runs, grid by grid.
#include "detail_select.glsl"

void main() {
  Tree tree = trees[gl_GlobalInvocationID.y];
  uint index = gl_GlobalInvocationID.x;
  if (index >= tree.entryCount) return;
  uint key = keys[tree.firstKey + index];
  if (key >= kGrids) return;
  Entry entry = entries[tree.firstEntry + index];
  uint place = 3u * atomicAdd(cursors[key], 1u);
  runs[place] = entry.ringA + tree.firstSkinned;
  runs[place + 1u] = entry.ringB + tree.firstSkinned;
  runs[place + 2u] = entry.shape;
}
