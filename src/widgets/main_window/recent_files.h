// The projects opened last, newest first (QSettings).
#pragma once

#include <QStringList>

namespace windfall::widgets {

/// Those that still exist; ten at most.
QStringList recentFiles();
void addRecentFile(const QString& path);

}  // namespace windfall::widgets
