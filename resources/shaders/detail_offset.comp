// Where each grid's runs begin; one invocation.
#include "detail_select.glsl"

void main() {
  if (gl_GlobalInvocationID.x != 0u) return;
  uint first = 0u;
  for (uint key = 0u; key < kGrids; ++key) {
    commands[5u * key + 4u] = first;
    cursors[key] = first;
    first += commands[5u * key + 1u];
  }
}
