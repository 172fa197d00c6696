// The inspector's groups of species, maps and ageing.
#include <QFileDialog>
#include <QFileInfo>
#include <QInputDialog>
#include <QPushButton>
#include <QSettings>

#include "model/document/durable_file.h"
#include "model/presets/preset.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/fields/preset_field.h"
#include "widgets/leaf/leaf_inspector.h"

namespace windfall::widgets {

using model::Aspect;
using model::LeafParameters;

namespace {

const QString kPresetFolder = QStringLiteral("presetFolder");

/// What belongs to the leaf rather than to its species stays as it is.
LeafParameters keepingOwn(LeafParameters made, const LeafParameters& now) {
  made.veins.seed = now.veins.seed;
  made.synthesis.size = now.synthesis.size;
  made.ageing.age = now.ageing.age;
  return made;
}

}  // namespace

void LeafInspector::addSpecies() {
  FieldGroup* group = addGroup(QStringLiteral("species"), tr("Species"));
  species_ = group->add(new PresetField(QStringLiteral("leaf")));
  species_->setToolTip(tr("Sets veins, synthesis, maps and ageing for a kind of leaf; one step to undo"));
  connect(species_, &PresetField::edited, this, [this](int index) {
    const model::Leaf* leaf = document_.project().leaf(leaf_);
    if (!leaf) return;
    const LeafParameters& now = leaf->parameters;
    const LeafParameters made = keepingOwn(species_->chosen(index, now, LeafParameters{}), now);
    document_.setLeaf(leaf_, &model::Leaf::parameters, made, Aspect::LeafParameters, tr("Species"));
  });
  refreshers_.push_back([this](const model::Leaf& leaf) {
    species_->show(leaf.parameters, keepingOwn(LeafParameters{}, leaf.parameters));
  });
  const auto button = [&](const QString& text, const QString& tip, const QString& iconName, auto slot) {
    QPushButton* made = group->addButton(text, iconName);
    made->setToolTip(tip);
    connect(made, &QPushButton::clicked, this, slot);
  };
  button(tr("Save as preset…"), tr("Keeps these numbers under a name"), QStringLiteral("save"),
         [this] { savePreset({}); });
  button(tr("Import preset…"), tr("Takes a preset that somebody shared"), QStringLiteral("import"), [this] {
    const QString path = QFileDialog::getOpenFileName(
        this, tr("Import Preset"), QSettings().value(kPresetFolder).toString(), tr("Presets (*.json)"));
    if (!path.isEmpty()) importPreset(path);
  });
  button(tr("Share preset…"), tr("Writes these numbers to a file for others"), QStringLiteral("export"), [this] {
    const QString path = QFileDialog::getSaveFileName(
        this, tr("Share Preset"), QSettings().value(kPresetFolder).toString(), tr("Presets (*.json)"));
    if (!path.isEmpty()) sharePreset(path);
  });
}

void LeafInspector::savePreset(QString name) {
  const model::Leaf* leaf = document_.project().leaf(leaf_);
  if (!leaf) return;
  if (name.isEmpty()) {
    name = QInputDialog::getText(this, tr("Save as Preset"), tr("Name of the species"), QLineEdit::Normal, leaf->name);
  }
  if (name.simplified().isEmpty()) return;
  model::PresetLibrary library;
  if (const Status saved = library.save(model::makePreset(name.simplified(), leaf->parameters)); !saved) {
    return emit message(tr("%1: %2").arg(name, QString::fromStdString(saved.error().message)), true);
  }
  species_->reload();
  refresh();
  emit message(tr("Preset %1 is kept").arg(name.simplified()), false);
}

void LeafInspector::importPreset(const QString& path) {
  QSettings().setValue(kPresetFolder, QFileInfo(path).absolutePath());
  model::PresetLibrary library;
  const Result<model::Preset> preset = library.import(path, QStringLiteral("leaf"));
  if (!preset) {
    return emit message(tr("%1: %2").arg(QFileInfo(path).fileName(), QString::fromStdString(preset.error().message)),
                        true);
  }
  species_->reload();
  refresh();
  emit message(tr("Preset %1 can be chosen now").arg(preset->name), false);
}

void LeafInspector::sharePreset(QString path) {
  const model::Leaf* leaf = document_.project().leaf(leaf_);
  if (!leaf) return;
  if (QFileInfo(path).suffix().isEmpty()) path += QStringLiteral(".json");
  QSettings().setValue(kPresetFolder, QFileInfo(path).absolutePath());
  const model::Preset preset = model::makePreset(leaf->name, leaf->parameters);
  if (const Status written = model::writeDurably(path, model::presetToJson(preset)); !written) {
    return emit message(tr("%1: %2").arg(QFileInfo(path).fileName(), QString::fromStdString(written.error().message)),
                        true);
  }
  emit message(tr("Preset written to %1").arg(path), false);
}

void LeafInspector::addMaps() {
  const model::MapParameters fresh;
  FieldGroup* group = addGroup(QStringLiteral("maps"), tr("Maps"));
  mapKind_ = group->add(new ChoiceField(tr("Show"),
                                        {tr("Under a light"), tr("Colour"), tr("Normal"), tr("Height"), tr("Roughness"),
                                         tr("Translucency"), tr("Occlusion")},
                                        0));
  mapKind_->setToolTip(tr("Which map the stage Maps shows"));
  connect(mapKind_, &ChoiceField::edited, this, [this](int index) { emit mapChosen(index); });
  const auto row = [&](const char* id, const QString& label, double model::MapParameters::*member, double most,
                       const QString& tip) {
    number(
        group, id, label, {.minimum = 0, .maximum = most, .defaultValue = fresh.*member},
        [member](const LeafParameters& p) { return p.maps.*member; },
        [member](LeafParameters& p, double v) { p.maps.*member = v; })
        ->setToolTip(tip);
  };
  row("maps.relief", tr("Relief"), &model::MapParameters::relief, 3,
      tr("Strength of the normal map; glossy leaves have about half"));
  row("maps.gloss", tr("Gloss"), &model::MapParameters::gloss, 1, tr("From dull to waxy"));
  row("maps.detail", tr("Fine detail"), &model::MapParameters::detail, 2,
      tr("How much of the picture's own light and dark becomes relief"));
  row("maps.thickness", tr("Thickness"), &model::MapParameters::thickness, 3,
      tr("Thick leaves let less light through"));
}

void LeafInspector::addAgeing() {
  const model::AgeingParameters fresh;
  FieldGroup* group = addGroup(QStringLiteral("ageing"), tr("Ageing"));
  const auto row = [&](const char* id, const QString& label, double model::AgeingParameters::*member, double low,
                       double most, const QString& unit, const QString& tip) {
    NumberField* field = number(
        group, id, label, {.minimum = low, .maximum = most, .defaultValue = fresh.*member, .unit = unit},
        [member](const LeafParameters& p) { return p.ageing.*member; },
        [member](LeafParameters& p, double v) { p.ageing.*member = v; });
    field->setToolTip(tip);
    return field;
  };
  age_ = row("ageing.age", tr("Age"), &model::AgeingParameters::age, 0, 1, {},
             tr("From the leaf as photographed over yellow and red to brown and dry; veins keep their green longest"));
  row("ageing.redness", tr("Redness"), &model::AgeingParameters::redness, 0, 1, {},
      tr("From species that turn yellow to those that turn red"));
  row("ageing.warmth", tr("Warmth"), &model::AgeingParameters::warmth, 0, 1, {},
      tr("Of the yellow: from lemon to copper"));
  row("ageing.temperature", tr("Temperature"), &model::AgeingParameters::temperature, -10, 30, QStringLiteral("°C"),
      tr("Of the autumn's days; cold leaves turn sooner. In the scene"));
  row("ageing.wetness", tr("Wetness"), &model::AgeingParameters::wetness, 0, 1, {},
      tr("Dry air browns and curls leaves; wet ones stay flat"));
}

}  // namespace windfall::widgets
