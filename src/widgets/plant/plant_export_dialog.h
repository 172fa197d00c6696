// What an exporter of plants asks for before it writes.
#pragma once

#include <QDialog>
#include <QJsonObject>
#include <functional>

#include "model/export/exporter.h"

namespace windfall::widgets {

class PlantExportDialog : public QDialog {
  Q_OBJECT
 public:
  PlantExportDialog(const model::Exporter& exporter, const QJsonObject& values, QWidget* parent = nullptr);
  /// By parameter key.
  QJsonObject values() const;

 private:
  std::vector<std::pair<QString, std::function<double()>>> fields_;
};

}  // namespace windfall::widgets
