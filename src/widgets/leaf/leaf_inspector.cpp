#include "widgets/leaf/leaf_inspector.h"

#include <QPushButton>

#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"

namespace windfall::widgets {

using model::Aspect;
using model::LeafParameters;

LeafInspector::LeafInspector(model::Document& document, QWidget* parent)
    : FieldPanel(QStringLiteral("leaf"), parent), document_(document) {
  const LeafParameters defaults;
  const QString px = tr("px"), degree = QStringLiteral("°");

  FieldGroup* source = addGroup(QStringLiteral("source"), tr("Source"));
  file_ = source->add(new InfoField(tr("Photo")));
  size_ = source->add(new InfoField(tr("Size")));
  bladeLength_ = source->add(new NumberField(tr("Blade length"), {.minimum = 0.5,
                                                                  .maximum = 50,
                                                                  .defaultValue = 100 * model::Leaf().bladeLength,
                                                                  .decimals = 1,
                                                                  .unit = tr("cm"),
                                                                  .logarithmic = true,
                                                                  .step = 0.5}));
  bladeLength_->setToolTip(tr("From the root to the tip, in the real world"));
  connect(bladeLength_, &NumberField::edited, this, [this](double cm) {
    document_.setLeaf(leaf_, &model::Leaf::bladeLength, cm / 100, Aspect::LeafParameters, tr("Blade length"),
                      bladeLength_->gesture());
  });
  connect(source->addButton(tr("Replace photo…"), QStringLiteral("photo")), &QPushButton::clicked, this,
          &LeafInspector::replacePhotoRequested);

  addSpecies();

  FieldGroup* contour = addGroup(QStringLiteral("contour"), tr("Contour"));
  number(
      contour, tr("Tolerance"), {.minimum = 0, .maximum = 40, .defaultValue = 0, .decimals = 1, .unit = px},
      [](const LeafParameters& p) { return p.epsilon; }, [](LeafParameters& p, double v) { p.epsilon = v; })
      ->setToolTip(tr("How far the simplified outline may stray from the mask's edge; 0 chooses by the photo's size"));

  FieldGroup* veins = addGroup(QStringLiteral("veins"), tr("Veins"));
  seed_ = veins->add(new SeedField(tr("Seed")));
  connect(seed_, &SeedField::edited, this,
          [this](quint64 seed) { edit(seed_, [seed](LeafParameters& p) { p.veins.seed = seed; }); });
  refreshers_.push_back([this](const model::Leaf& leaf) { seed_->setValue(leaf.parameters.veins.seed); });
  laterals_ = number(
      veins, tr("Laterals a side"),
      {.minimum = 0, .maximum = 24, .defaultValue = double(defaults.veins.laterals), .decimals = 0},
      [](const LeafParameters& p) { return p.veins.laterals; },
      [](LeafParameters& p, double v) { p.veins.laterals = int(v); });
  number(
      veins, tr("Base angle"),
      {.minimum = 10, .maximum = 90, .defaultValue = defaults.veins.basalAngle, .decimals = 0, .unit = degree},
      [](const LeafParameters& p) { return p.veins.basalAngle; },
      [](LeafParameters& p, double v) { p.veins.basalAngle = v; });
  number(
      veins, tr("Tip angle"),
      {.minimum = 10, .maximum = 90, .defaultValue = defaults.veins.apicalAngle, .decimals = 0, .unit = degree},
      [](const LeafParameters& p) { return p.veins.apicalAngle; },
      [](LeafParameters& p, double v) { p.veins.apicalAngle = v; });
  number(
      veins, tr("Wiggle"),
      {.minimum = 0, .maximum = 45, .defaultValue = defaults.veins.wiggle, .decimals = 0, .unit = degree},
      [](const LeafParameters& p) { return p.veins.wiggle; }, [](LeafParameters& p, double v) { p.veins.wiggle = v; });

  FieldGroup* distance = addGroup(QStringLiteral("distance"), tr("Structural distance"));
  const auto cost = [&](const QString& label, int model::DistanceCosts::*member) {
    number(
        distance, label, {.minimum = 1, .maximum = 32, .defaultValue = double(defaults.costs.*member), .decimals = 0},
        [member](const LeafParameters& p) { return p.costs.*member; },
        [member](LeafParameters& p, double v) { p.costs.*member = int(v); })
        ->setToolTip(tr("Cost of a step; the ratio of the three shapes the distance"));
  };
  cost(tr("Along a vein"), &model::DistanceCosts::veinVein);
  cost(tr("Vein to tissue"), &model::DistanceCosts::veinTissue);
  cost(tr("Through tissue"), &model::DistanceCosts::tissueTissue);

  FieldGroup* synthesis = addGroup(QStringLiteral("synthesis"), tr("Synthesis"));
  auto* method = synthesis->add(
      new ChoiceField(tr("Method"), {tr("Classic"), tr("Guided by veins")}, defaults.synthesis.guided ? 1 : 0));
  method->setToolTip(tr("Classic draws superpixels by region and distance; guided lays patches along the veins"));
  connect(method, &ChoiceField::edited, this,
          [this, method](int index) { edit(method, [index](LeafParameters& p) { p.synthesis.guided = index == 1; }); });
  refreshers_.push_back(
      [method](const model::Leaf& leaf) { method->setValue(leaf.parameters.synthesis.guided ? 1 : 0); });
  number(
      synthesis, tr("Texture size"),
      {.minimum = 128,
       .maximum = 4096,
       .defaultValue = double(defaults.synthesis.size),
       .decimals = 0,
       .unit = px,
       .logarithmic = true,
       .step = 128},
      [](const LeafParameters& p) { return p.synthesis.size; },
      [](LeafParameters& p, double v) { p.synthesis.size = int(v); });
  number(
      synthesis, tr("Superpixels"),
      {.minimum = 64,
       .maximum = 32768,
       .defaultValue = double(defaults.synthesis.superpixels),
       .decimals = 0,
       .logarithmic = true,
       .step = 64},
      [](const LeafParameters& p) { return p.synthesis.superpixels; },
      [](LeafParameters& p, double v) { p.synthesis.superpixels = int(v); });
  number(
      synthesis, tr("Candidates"),
      {.minimum = 1, .maximum = 64, .defaultValue = double(defaults.synthesis.candidates), .decimals = 0},
      [](const LeafParameters& p) { return p.synthesis.candidates; },
      [](LeafParameters& p, double v) { p.synthesis.candidates = int(v); })
      ->setToolTip(tr("How many of the nearest superpixels one is drawn from: more, the more variants differ"));
  number(
      synthesis, tr("Smoothing"), {.minimum = 0, .maximum = 4, .defaultValue = defaults.synthesis.smoothing},
      [](const LeafParameters& p) { return p.synthesis.smoothing; },
      [](LeafParameters& p, double v) { p.synthesis.smoothing = v; });

  addMaps();
  addAgeing();

  connect(&document_, &model::Document::changed, this, [this](const model::Change& change) {
    if (change.aspect == Aspect::Everything || change.asset == leaf_) refresh();
  });
  setEnabled(false);
}

NumberField* LeafInspector::number(FieldGroup* group, const QString& label, const NumberSpec& spec,
                                   std::function<double(const LeafParameters&)> get,
                                   std::function<void(LeafParameters&, double)> set) {
  auto* field = group->add(new NumberField(label, spec));
  connect(field, &NumberField::edited, this, [this, field, set = std::move(set)](double value) {
    edit(field, [&](LeafParameters& p) { set(p, value); });
  });
  refreshers_.push_back(
      [field, get = std::move(get)](const model::Leaf& leaf) { field->setValue(get(leaf.parameters)); });
  return field;
}

void LeafInspector::edit(const Field* field, const std::function<void(LeafParameters&)>& change) {
  const model::Leaf* leaf = document_.project().leaf(leaf_);
  if (!leaf) return;
  LeafParameters parameters = leaf->parameters;
  change(parameters);
  document_.setLeaf(leaf_, &model::Leaf::parameters, parameters, Aspect::LeafParameters, field->label(),
                    field->gesture());
}

void LeafInspector::setLeaf(model::AssetId leaf) {
  leaf_ = leaf;
  refresh();
}

void LeafInspector::setPhotoSize(QSize size) {
  size_->setValue(size.isEmpty() ? QString() : tr("%1 × %2 px").arg(size.width()).arg(size.height()));
}

void LeafInspector::refresh() {
  const model::Leaf* leaf = document_.project().leaf(leaf_);
  setEnabled(leaf);
  file_->setValue(leaf ? leaf->photo.name : QString());
  if (!leaf) return;
  bladeLength_->setValue(100 * leaf->bladeLength);
  for (const auto& refreshRow : refreshers_) refreshRow(*leaf);
}

}  // namespace windfall::widgets
