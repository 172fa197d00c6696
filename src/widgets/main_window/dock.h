// A dock with a flat title in our look.
#pragma once

#include <QDockWidget>

namespace windfall::widgets {

/// `name` is the object name under which the layout is saved.
class Dock : public QDockWidget {
  Q_OBJECT
 public:
  Dock(const QString& name, const QString& title, QWidget* parent = nullptr);
};

}  // namespace windfall::widgets
