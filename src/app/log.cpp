#include "app/log.h"

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QMutex>
#include <QStandardPaths>
#include <cstdio>

namespace windfall::app {

namespace {

constexpr qint64 kLargest = 1 << 20;  // bytes
constexpr int kKept = 3;

struct Log {
  QMutex mutex;
  QFile file;
  bool verbose = false;
};

Log& theLog() {
  static Log log;
  return log;
}

QString numbered(int number) {
  QString name = logFile();
  if (number > 0) name.replace(QStringLiteral(".log"), QStringLiteral(".%1.log").arg(number));
  return name;
}

void rotate() {
  QFile::remove(numbered(kKept));
  for (int i = kKept - 1; i >= 0; --i) QFile::rename(numbered(i), numbered(i + 1));
}

void write(QtMsgType type, const QMessageLogContext& context, const QString& text) {
  static const char* const levels[] = {"debug", "warning", "error", "fatal", "info"};
  const QString category = context.category && qstrcmp(context.category, "default") != 0
                               ? QString::fromLatin1(context.category) + QStringLiteral(": ")
                               : QString();
  const QByteArray line = QStringLiteral("%1 %2 %3%4\n")
                              .arg(QDateTime::currentDateTime().toString(Qt::ISODateWithMs),
                                   QString::fromLatin1(levels[type]), category, text)
                              .toUtf8();
  Log& log = theLog();
  const QMutexLocker lock(&log.mutex);
  if (log.file.isOpen()) {
    log.file.write(line);
    log.file.flush();
  }
  if (log.verbose || (type != QtDebugMsg && type != QtInfoMsg)) {
    std::fprintf(stderr, "windfall: %s%s\n", qUtf8Printable(category), qUtf8Printable(text));
  }
}

}  // namespace

QString logFile() {
  return QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + QStringLiteral("/windfall.log");
}

void startLog(bool verbose) {
  Log& log = theLog();
  log.verbose = verbose;
  QDir().mkpath(QFileInfo(logFile()).path());
  if (QFileInfo(logFile()).size() > kLargest) rotate();
  log.file.setFileName(logFile());
  // A log that can't be written is no reason not to start.
  (void)log.file.open(QIODevice::WriteOnly | QIODevice::Append);
  qInstallMessageHandler(write);
}

}  // namespace windfall::app
