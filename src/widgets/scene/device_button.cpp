#include "widgets/scene/device_button.h"

#include <QActionGroup>
#include <QMenu>
#include <QSettings>

#include "widgets/look/icon.h"
#include "widgets/scene/simulation_controller.h"

namespace windfall::widgets {
namespace {

const QString kSetting = QStringLiteral("simulation/device");

QString keyOf(sim::Device device) {
  return device == sim::Device::Cpu    ? QStringLiteral("cpu")
         : device == sim::Device::Cuda ? QStringLiteral("cuda")
                                       : QStringLiteral("auto");
}

}  // namespace

DeviceButton::DeviceButton(SimulationController& controller, QWidget* parent)
    : QToolButton(parent), controller_(controller), choices_(new QActionGroup(this)) {
  setIcon(widgets::icon("device"));
  setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  setPopupMode(QToolButton::InstantPopup);
  setFocusPolicy(Qt::NoFocus);
  setObjectName("deviceButton");
  setToolTip(tr("Where the simulation runs"));
  auto* menu = new QMenu(this);
  const QString wanted = QSettings().value(kSetting, "auto").toString();
  const auto add = [&](const QString& name, sim::Device device) {
    QAction* action = menu->addAction(name);
    action->setCheckable(true);
    choices_->addAction(action);
    connect(action, &QAction::triggered, this, [this, device] {
      QSettings().setValue(kSetting, keyOf(device));
      controller_.setDevice(device);
    });
    if (keyOf(device) != wanted) return;
    action->setChecked(true);
    controller_.setDevice(device);
  };
  add(tr("Automatic"), sim::Device::Auto);
  for (const sim::DeviceInfo& info : sim::devices()) add(QString::fromStdString(info.name), info.device);
  if (choices_->checkedAction() == nullptr) menu->actions().front()->setChecked(true);
  setMenu(menu);
  connect(&controller_, &SimulationController::reported, this, &DeviceButton::showDevice);
  showDevice();
}

void DeviceButton::showDevice() {
  const QString name = QString::fromStdString(controller_.last().device.name);
  const QString shown = name.isEmpty() ? choices_->checkedAction()->text() : name;
  if (text() != shown) setText(shown);
}

}  // namespace windfall::widgets
