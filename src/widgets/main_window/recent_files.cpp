#include "widgets/main_window/recent_files.h"

#include <QFileInfo>
#include <QSettings>

namespace windfall::widgets {

namespace {
const QString kKey = QStringLiteral("recentFiles");
}

QStringList recentFiles() {
  QStringList files = QSettings().value(kKey).toStringList();
  files.removeIf([](const QString& file) { return !QFileInfo::exists(file); });
  return files;
}

void addRecentFile(const QString& path) {
  QStringList files = QSettings().value(kKey).toStringList();
  const QString absolute = QFileInfo(path).absoluteFilePath();
  files.removeAll(absolute);
  files.prepend(absolute);
  QSettings().setValue(kKey, files.mid(0, 10));
}

}  // namespace windfall::widgets
