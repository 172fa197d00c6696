#include "model/document/names.h"

#include <QRegularExpression>

namespace windfall::model {

QString uniqueName(const QString& wanted, const QStringList& taken, const QString& fallback) {
  QString name = wanted.simplified();
  if (name.isEmpty()) name = fallback;
  if (!taken.contains(name)) return name;
  static const QRegularExpression numbered(QStringLiteral("^(.*\\S) (\\d{1,6})$"));
  const QRegularExpressionMatch match = numbered.match(name);
  const QString stem = match.hasMatch() ? match.captured(1) : name;
  for (int number = match.hasMatch() ? match.captured(2).toInt() + 1 : 2;; ++number) {
    QString candidate = QStringLiteral("%1 %2").arg(stem).arg(number);
    if (!taken.contains(candidate)) return candidate;
  }
}

}  // namespace windfall::model
