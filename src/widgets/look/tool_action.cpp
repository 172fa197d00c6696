#include "widgets/look/tool_action.h"

#include <QAction>

#include "widgets/look/icon.h"

namespace windfall::widgets {

QAction* toolAction(QObject* parent, const QString& iconName, const QString& text, const QString& help,
                    const QKeySequence& shortcut) {
  auto* action = new QAction(icon(iconName), text, parent);
  action->setCheckable(true);
  action->setShortcut(shortcut);
  action->setStatusTip(help);
  action->setToolTip(QStringLiteral("%1 (%2)").arg(text, shortcut.toString(QKeySequence::NativeText)));
  return action;
}

}  // namespace windfall::widgets
