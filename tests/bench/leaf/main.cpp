// windfall-bench-leaf: the benchmarks of leaf textures beside other people's programs.
#include "../program.h"
#include "ximgproc.h"

int main(int count, char** arguments) {
  return runProgram("windfall-bench-leaf", windfall::model::textureBenchmarks({openCvSlic()}), count, arguments);
}
