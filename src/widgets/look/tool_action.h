// Actions that choose a tool of a canvas.
#pragma once

#include <QKeySequence>
#include <QString>

class QAction;
class QObject;

namespace windfall::widgets {

/// Checkable, with an icon of ours; its tool tip tells the key, its status tip the help.
QAction* toolAction(QObject* parent, const QString& iconName, const QString& text, const QString& help,
                    const QKeySequence& shortcut);

}  // namespace windfall::widgets
