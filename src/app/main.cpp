#include "app/run.h"

int main(int argc, char** argv) { return windfall::app::run(argc, argv); }
