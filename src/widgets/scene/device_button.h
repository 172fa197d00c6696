// The device that simulates: its name, and a menu to choose another.
#pragma once

#include <QToolButton>

class QActionGroup;

namespace windfall::widgets {

class SimulationController;

/// Stands at the end of the top bar. The choice is remembered for this machine, not in the project.
class DeviceButton : public QToolButton {
  Q_OBJECT
 public:
  explicit DeviceButton(SimulationController& controller, QWidget* parent = nullptr);

 private:
  void showDevice();

  SimulationController& controller_;
  QActionGroup* choices_;
};

}  // namespace windfall::widgets
