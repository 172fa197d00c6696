// The log file: what Qt and we say while the editor runs.
#pragma once

#include <QString>

namespace windfall::app {

/// Sends every message to windfall.log in the application's data folder; the last three sessions' worth (1 MiB each)
/// are kept as windfall.1.log and so on. `verbose`: all of them on standard error too, else warnings only.
void startLog(bool verbose);
QString logFile();

}  // namespace windfall::app
