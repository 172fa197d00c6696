// The program: a subcommand, or the editor.
#pragma once

namespace windfall::app {

/// Returns the process's exit status: 0, 1 (failed), 2 (wrong usage), 130 (cancelled).
int run(int argc, char** argv);

}  // namespace windfall::app
