#include "widgets/plant/plant_export_dialog.h"

#include <QDialogButtonBox>
#include <QPushButton>
#include <QVBoxLayout>

#include "widgets/fields/number_field.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

PlantExportDialog::PlantExportDialog(const model::Exporter& exporter, const QJsonObject& values, QWidget* parent)
    : QDialog(parent) {
  setWindowTitle(exporter.title());
  auto* column = new QVBoxLayout(this);
  column->setSpacing(2 * kGrid);
  for (const model::ExportParameter& parameter : exporter.parameters()) {
    auto* field = new NumberField(parameter.title, {.minimum = parameter.low,
                                                    .maximum = parameter.high > 1000 ? 1000 : parameter.high,
                                                    .defaultValue = parameter.initial,
                                                    .decimals = parameter.whole ? 0 : 2,
                                                    .hardMinimum = parameter.low,
                                                    .hardMaximum = parameter.high});
    field->setObjectName("export." + parameter.key);
    field->setValue(values.value(parameter.key).toDouble(parameter.initial));
    column->addWidget(field);
    fields_.emplace_back(parameter.key, field);
  }
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  buttons->button(QDialogButtonBox::Ok)->setText(tr("Export"));
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  column->addWidget(buttons);
  setMinimumWidth(420);
}

QJsonObject PlantExportDialog::values() const {
  QJsonObject values;
  for (const auto& [key, field] : fields_) values[key] = field->value();
  return values;
}

}  // namespace windfall::widgets
