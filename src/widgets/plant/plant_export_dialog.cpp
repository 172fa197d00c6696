#include "widgets/plant/plant_export_dialog.h"

#include <QDialogButtonBox>
#include <QPushButton>
#include <QVBoxLayout>

#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

PlantExportDialog::PlantExportDialog(const model::Exporter& exporter, const QJsonObject& values, QWidget* parent)
    : QDialog(parent) {
  setWindowTitle(exporter.title());
  auto* column = new QVBoxLayout(this);
  column->setSpacing(2 * kGrid);
  for (const model::ExportParameter& parameter : exporter.parameters()) {
    const double now = values.value(parameter.key).toDouble(parameter.initial);
    if (!parameter.choices.isEmpty()) {
      auto* choice = new ChoiceField(parameter.title, parameter.choices, static_cast<int>(parameter.initial));
      choice->setObjectName("export." + parameter.key);
      choice->setToolTip(parameter.help);
      choice->setValue(static_cast<int>(now));
      column->addWidget(choice);
      fields_.emplace_back(parameter.key, [choice] { return choice->value(); });
      continue;
    }
    auto* field = new NumberField(parameter.title, {.minimum = parameter.low,
                                                    .maximum = parameter.high > 1000 ? 1000 : parameter.high,
                                                    .defaultValue = parameter.initial,
                                                    .decimals = parameter.whole ? 0 : 2,
                                                    .hardMinimum = parameter.low,
                                                    .hardMaximum = parameter.high});
    field->setObjectName("export." + parameter.key);
    field->setToolTip(parameter.help);
    field->setValue(now);
    column->addWidget(field);
    fields_.emplace_back(parameter.key, [field] { return field->value(); });
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
  for (const auto& [key, value] : fields_) values[key] = value();
  return values;
}

}  // namespace windfall::widgets
