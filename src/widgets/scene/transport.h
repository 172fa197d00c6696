// Play, step, reset and the time of a simulation.
#pragma once

#include <QAction>
#include <QElapsedTimer>
#include <QWidget>

class QLabel;

namespace windfall::widgets {

class SimulationController;

class Transport : public QWidget {
  Q_OBJECT
 public:
  explicit Transport(SimulationController& controller, QWidget* parent = nullptr);

  /// For menus and shortcuts too; Space plays, Right steps, Ctrl+Home resets.
  QAction* playAction() const { return play_; }
  QAction* stepAction() const { return step_; }
  QAction* resetAction() const { return reset_; }

 private:
  void showState();

  SimulationController& controller_;
  QAction *play_, *step_, *reset_;
  QLabel *time_, *lost_;
};

}  // namespace windfall::widgets
