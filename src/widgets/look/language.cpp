#include "widgets/look/language.h"

#include <QCoreApplication>
#include <QTranslator>

namespace windfall::widgets {

void installPlurals(QCoreApplication& application) {
  const QString name = QStringLiteral("windfall plurals");
  if (application.findChild<QTranslator*>(name)) return;
  auto* translator = new QTranslator(&application);
  translator->setObjectName(name);
  // Without the file the texts keep their plural form.
  if (translator->load(QStringLiteral(":/i18n/windfall_en.qm"))) QCoreApplication::installTranslator(translator);
}

}  // namespace windfall::widgets
