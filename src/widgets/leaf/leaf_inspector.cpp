#include "widgets/leaf/leaf_inspector.h"

#include <QPushButton>
#include <QScrollBar>
#include <QTimer>
#include <utility>

#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"

namespace windfall::widgets {

using model::Aspect;
using model::LeafParameters;

LeafInspector::LeafInspector(model::Document& document, QWidget* parent)
    : FieldPanel(QStringLiteral("leaf"), parent), document_(document) {
  addSource();
  addSpecies();
  addContour();
  addShape();
  addVeins();
  addDistance();
  addRegions();
  addSynthesis();
  addMaps();
  addAgeing();
  connect(&document_, &model::Document::changed, this, [this](const model::Change& change) {
    if (change.aspect == Aspect::Everything || change.asset == leaf_) refresh();
  });
  setEnabled(false);
}

FieldGroup* LeafInspector::addGroup(const QString& id, const QString& title) {
  FieldGroup* group = FieldPanel::addGroup(id, title);
  groups_.insert(id, group);
  return group;
}

void LeafInspector::showEvent(QShowEvent* event) {
  FieldPanel::showEvent(event);
  // Once: rows have their places after the event.
  if (!std::exchange(seen_, true)) QTimer::singleShot(0, this, [this] { showStage(stage_); });
}

void LeafInspector::showStage(model::Stage stage) {
  stage_ = stage;
  using model::Stage;
  const char* id = stage == Stage::Mask || stage == Stage::Contour           ? "contour"
                   : stage == Stage::Veins                                   ? "veins"
                   : stage == Stage::Distance                                ? "distance"
                   : stage == Stage::Regions                                 ? "regions"
                   : stage == Stage::Superpixels || stage == Stage::Variants ? "synthesis"
                   : stage == Stage::Maps                                    ? "maps"
                                                                             : "source";
  const FieldGroup* group = groups_.value(QLatin1String(id));
  if (group && stage != Stage::Atlas) verticalScrollBar()->setValue(group->y());
}

void LeafInspector::addSource() {
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
  bladeLength_->setToolTip(tr("From the root to the tip, in the real world; a ruler in the photo gives it too"));
  connect(bladeLength_, &NumberField::edited, this, [this](double cm) {
    document_.setLeaf(leaf_, &model::Leaf::bladeLength, cm / 100, Aspect::LeafParameters, tr("Blade length"),
                      bladeLength_->gesture());
  });
  rulerLength_ = source->add(new NumberField(tr("Ruler"), {.minimum = 0.5,
                                                           .maximum = 100,
                                                           .defaultValue = 100 * model::Ruler().metres,
                                                           .decimals = 2,
                                                           .unit = tr("cm"),
                                                           .logarithmic = true,
                                                           .step = 0.5}));
  rulerLength_->setToolTip(tr("What the line that was drawn with the ruler tool measures in the real world"));
  connect(rulerLength_, &NumberField::edited, this, [this](double cm) {
    const model::Leaf* leaf = document_.project().leaf(leaf_);
    if (!leaf) return;
    model::Ruler ruler = leaf->ruler;
    ruler.metres = cm / 100;
    document_.setLeaf(leaf_, &model::Leaf::ruler, ruler, Aspect::LeafParameters, tr("Ruler"), rulerLength_->gesture());
  });
  connect(source->addButton(tr("Replace photo…"), QStringLiteral("photo")), &QPushButton::clicked, this,
          &LeafInspector::replacePhotoRequested);
}

void LeafInspector::addContour() {
  FieldGroup* contour = addGroup(QStringLiteral("contour"), tr("Mask and contour"));
  flag(
      contour, "mask.keepHoles", tr("Keep holes"), true,
      tr("Places inside the blade that look like ground stay holes; else the automatic mask fills them"),
      [](const LeafParameters& p) { return p.mask.keepHoles; },
      [](LeafParameters& p, bool on) { p.mask.keepHoles = on; });
  number(
      contour, "epsilon", tr("Tolerance"),
      {.minimum = 0, .maximum = 40, .defaultValue = 0, .decimals = 1, .unit = tr("px")},
      [](const LeafParameters& p) { return p.epsilon; }, [](LeafParameters& p, double v) { p.epsilon = v; })
      ->setToolTip(tr("How far the simplified outline may stray from the mask's edge; 0 chooses by the photo's size"));
  vertices_ = contour->add(new InfoField(tr("Vertices")));
}

void LeafInspector::addShape() {
  const model::ShapeParameters defaults;
  FieldGroup* shape = addGroup(QStringLiteral("shape"), tr("Shape of variants"));
  flag(
      shape, "shape.vary", tr("Vary"), false, tr("Every variant gets an outline and veins of its own, by its seed"),
      [](const LeafParameters& p) { return p.shape.vary; }, [](LeafParameters& p, bool on) { p.shape.vary = on; });
  const auto share = [&](const char* id, const QString& label, double model::ShapeParameters::*member, double most,
                         const QString& help) {
    number(
        shape, id, label,
        {.minimum = 0, .maximum = 100 * most, .defaultValue = 100 * defaults.*member, .decimals = 0, .unit = tr("%")},
        [member](const LeafParameters& p) { return 100 * p.shape.*member; },
        [member](LeafParameters& p, double v) { p.shape.*member = v / 100; })
        ->setToolTip(help);
  };
  const auto count = [&](const char* id, const QString& label, int model::ShapeParameters::*member, double least,
                         double most, const QString& help) {
    number(
        shape, id, label, {.minimum = least, .maximum = most, .defaultValue = double(defaults.*member), .decimals = 0},
        [member](const LeafParameters& p) { return p.shape.*member; },
        [member](LeafParameters& p, double v) { p.shape.*member = int(v); })
        ->setToolTip(help);
  };
  share("shape.aspect", tr("Width"), &model::ShapeParameters::aspect, 0.5, tr("How much the width differs"));
  share("shape.asymmetry", tr("Asymmetry"), &model::ShapeParameters::asymmetry, 0.5,
        tr("How much the halves differ, and the midrib bends"));
  share("shape.lobes", tr("Lobes"), &model::ShapeParameters::lobes, 0.4, tr("How much lobes swell, shrink and move"));
  share("shape.teeth", tr("Teeth"), &model::ShapeParameters::teeth, 0.3, tr("Depth of teeth added along the margin"));
  count("shape.toothCount", tr("Teeth a side"), &model::ShapeParameters::toothCount, 4, 80, tr("How many teeth"));
  count("shape.holes", tr("Holes"), &model::ShapeParameters::holes, 0, 12, tr("At most so many holes are eaten"));
  count("shape.bites", tr("Bites"), &model::ShapeParameters::bites, 0, 12, tr("At most so many bites at the margin"));
}

void LeafInspector::addVeins() {
  const model::VeinParameters defaults;
  const QString degree = QStringLiteral("°"), percent = tr("%");
  using Veins = model::VeinParameters;
  FieldGroup* veins = addGroup(QStringLiteral("veins"), tr("Veins"));
  const auto real = [&](const char* id, const QString& label, double Veins::*member, const NumberSpec& spec,
                        double factor = 1) {
    NumberSpec whole = spec;
    whole.defaultValue = factor * defaults.*member;
    return number(
        veins, id, label, whole, [member, factor](const LeafParameters& p) { return factor * p.veins.*member; },
        [member, factor](LeafParameters& p, double v) { p.veins.*member = v / factor; });
  };
  const auto check = [&](const char* id, const QString& label, bool Veins::*member, const QString& help) {
    return flag(
        veins, id, label, defaults.*member, help, [member](const LeafParameters& p) { return p.veins.*member; },
        [member](LeafParameters& p, bool on) { p.veins.*member = on; });
  };
  veinsFound_ = veins->add(new InfoField(tr("In use")));
  auto* source = veins->add(new ChoiceField(tr("From"), {tr("Growth"), tr("The photo")}, 0));
  source->setToolTip(tr("Veins that are not drawn by hand: grown by seed, or read from the photo"));
  connect(source, &ChoiceField::edited, this,
          [this, source](int index) { edit(source, [index](LeafParameters& p) { p.veins.fromPhoto = index == 1; }); });
  refreshers_.push_back([source](const model::Leaf& leaf) { source->setValue(leaf.parameters.veins.fromPhoto); });
  real("veins.detail", tr("Photo detail"), &Veins::detail,
       {.minimum = 0.05, .maximum = 5, .decimals = 2, .unit = percent, .logarithmic = true, .step = 0.05}, 100)
      ->setToolTip(tr("Share of the blade that a vein of the photo must serve: less shows finer veins"));
  seed_ = veins->add(new SeedField(tr("Seed")));
  connect(seed_, &SeedField::edited, this,
          [this](quint64 seed) { edit(seed_, [seed](LeafParameters& p) { p.veins.seed = seed; }); });
  refreshers_.push_back([this](const model::Leaf& leaf) { seed_->setValue(leaf.parameters.veins.seed); });
  number(
      veins, "veins.mains", tr("Main veins"), {.minimum = 0, .maximum = 9, .defaultValue = 0, .decimals = 0},
      [](const LeafParameters& p) { return p.veins.mains; },
      [](LeafParameters& p, double v) { p.veins.mains = int(v); })
      ->setToolTip(tr("0: as many as the outline has tips that stand out"));
  laterals_ = number(
      veins, "veins.laterals", tr("Laterals a side"),
      {.minimum = 0, .maximum = 24, .defaultValue = double(defaults.laterals), .decimals = 0},
      [](const LeafParameters& p) { return p.veins.laterals; },
      [](LeafParameters& p, double v) { p.veins.laterals = int(v); });
  real("veins.basalAngle", tr("Base angle"), &Veins::basalAngle,
       {.minimum = 10, .maximum = 90, .decimals = 0, .unit = degree});
  real("veins.apicalAngle", tr("Tip angle"), &Veins::apicalAngle,
       {.minimum = 10, .maximum = 90, .decimals = 0, .unit = degree});
  real("veins.wiggle", tr("Wiggle"), &Veins::wiggle, {.minimum = 0, .maximum = 45, .decimals = 0, .unit = degree});
  real("veins.firstLateral", tr("First lateral"), &Veins::firstLateral,
       {.minimum = 0, .maximum = 100, .decimals = 0, .unit = percent}, 100)
      ->setToolTip(tr("Where along the main vein the laterals begin"));
  real("veins.lastLateral", tr("Last lateral"), &Veins::lastLateral,
       {.minimum = 0, .maximum = 100, .decimals = 0, .unit = percent}, 100)
      ->setToolTip(tr("Where along the main vein the laterals end"));
  real("veins.stagger", tr("Stagger"), &Veins::stagger, {.minimum = 0, .maximum = 50, .decimals = 0, .unit = percent},
       100)
      ->setToolTip(tr("0: laterals in pairs; 50: left and right alternate"));
  check("veins.leftSide", tr("Left side"), &Veins::leftSide, tr("Laterals to the left, seen from root to tip"));
  check("veins.rightSide", tr("Right side"), &Veins::rightSide, tr("Laterals to the right, seen from root to tip"));
  check("veins.bezier", tr("Bézier curves"), &Veins::bezier,
        tr("Each vein one Bézier curve, as in the thesis: smoother, with less wiggle"));
  check("veins.micro", tr("Finer veins"), &Veins::micro, tr("Tertiary and micro veins between the laterals"));
  check("veins.closed", tr("In loops"), &Veins::closed, tr("Finer veins meet; else they end freely"));
  real("veins.microSpacing", tr("Mesh width"), &Veins::microSpacing,
       {.minimum = 0.8, .maximum = 8, .decimals = 1, .unit = percent}, 100)
      ->setToolTip(tr("Distance between finer veins, of the leaf's long side"));
  connect(veins->addButton(tr("Load vein picture…"), QStringLiteral("vein")), &QPushButton::clicked, this,
          &LeafInspector::loadVeinsRequested);
}

void LeafInspector::addDistance() {
  const model::DistanceCosts defaults;
  FieldGroup* distance = addGroup(QStringLiteral("distance"), tr("Structural distance"));
  const auto cost = [&](const char* id, const QString& label, int model::DistanceCosts::*member) {
    number(
        distance, id, label, {.minimum = 1, .maximum = 32, .defaultValue = double(defaults.*member), .decimals = 0},
        [member](const LeafParameters& p) { return p.costs.*member; },
        [member](LeafParameters& p, double v) { p.costs.*member = int(v); })
        ->setToolTip(tr("Cost of a step; the ratio of the three shapes the distance"));
  };
  cost("costs.veinVein", tr("Along a vein"), &model::DistanceCosts::veinVein);
  cost("costs.veinTissue", tr("Vein to tissue"), &model::DistanceCosts::veinTissue);
  cost("costs.tissueTissue", tr("Through tissue"), &model::DistanceCosts::tissueTissue);
}

void LeafInspector::addRegions() {
  const model::RegionParameters defaults;
  FieldGroup* regions = addGroup(QStringLiteral("regions"), tr("Regions"));
  auto* similarity = regions->add(new ChoiceField(tr("Similarity"), {tr("By shares"), tr("As in the thesis")}, 0));
  similarity->setToolTip(tr("By shares does not change with the resolution; the thesis compares areas in pixels"));
  connect(similarity, &ChoiceField::edited, this, [this, similarity](int index) {
    edit(similarity, [index](LeafParameters& p) { p.regions.scaleFree = index == 0; });
  });
  refreshers_.push_back(
      [similarity](const model::Leaf& leaf) { similarity->setValue(leaf.parameters.regions.scaleFree ? 0 : 1); });
  number(
      regions, "regions.best", tr("Best"),
      {.minimum = 1, .maximum = 100, .defaultValue = 100 * defaults.best, .decimals = 0, .unit = tr("%")},
      [](const LeafParameters& p) { return 100 * p.regions.best; },
      [](LeafParameters& p, double v) { p.regions.best = v / 100; })
      ->setToolTip(tr("Share of the example's regions, most similar first, that one is drawn from"));
  flag(
      regions, "regions.mix", tr("Mix examples"), defaults.mix,
      tr("Of several examples every texture takes regions of all; else each texture takes one example, in turn"),
      [](const LeafParameters& p) { return p.regions.mix; }, [](LeafParameters& p, bool on) { p.regions.mix = on; });
  number(
      regions, "regions.evenTones", tr("Even tones"),
      {.minimum = 0, .maximum = 100, .defaultValue = 100 * defaults.evenTones, .decimals = 0, .unit = tr("%")},
      [](const LeafParameters& p) { return 100 * p.regions.evenTones; },
      [](LeafParameters& p, double v) { p.regions.evenTones = v / 100; })
      ->setToolTip(
          tr("How far casts between mixed examples are taken away, so that their regions fit to each other; leaves "
             "of quite other colours, summer beside autumn, stay as they are"));
  flag(
      regions, "regions.hold", tr("Hold choice"), false,
      tr("All variants take the same regions; only colours are drawn again"),
      [](const LeafParameters& p) { return p.regions.hold; }, [](LeafParameters& p, bool on) { p.regions.hold = on; });
  auto* seed = regions->add(new SeedField(tr("Choice seed")));
  seed->setToolTip(tr("Which regions are chosen where the choice is held"));
  connect(seed, &SeedField::edited, this,
          [this, seed](quint64 value) { edit(seed, [value](LeafParameters& p) { p.regions.seed = value; }); });
  refreshers_.push_back([seed](const model::Leaf& leaf) { seed->setValue(leaf.parameters.regions.seed); });
}

void LeafInspector::addSynthesis() {
  const LeafParameters defaults;
  const QString px = tr("px");
  FieldGroup* synthesis = addGroup(QStringLiteral("synthesis"), tr("Synthesis"));
  auto* method = synthesis->add(
      new ChoiceField(tr("Method"), {tr("Classic"), tr("Guided by veins")}, defaults.synthesis.guided ? 1 : 0));
  method->setToolTip(tr("Classic draws superpixels by region and distance; guided lays patches along the veins"));
  connect(method, &ChoiceField::edited, this,
          [this, method](int index) { edit(method, [index](LeafParameters& p) { p.synthesis.guided = index == 1; }); });
  refreshers_.push_back(
      [method](const model::Leaf& leaf) { method->setValue(leaf.parameters.synthesis.guided ? 1 : 0); });
  number(
      synthesis, "synthesis.size", tr("Texture size"),
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
      synthesis, "synthesis.variety", tr("Variety"),
      {.minimum = 0, .maximum = 20, .defaultValue = defaults.synthesis.variety, .decimals = 1, .unit = tr("ΔE")},
      [](const LeafParameters& p) { return p.synthesis.variety; },
      [](LeafParameters& p, double v) { p.synthesis.variety = v; })
      ->setToolTip(tr("How far variants differ in colour on the mean, at least: where the example is too even for it, "
                      "each leaf gets a tone of its own, out of the example's colours; 0 leaves them alike"));
  std::vector<QWidget*> ofClassic, ofGuided;
  ofGuided.push_back(number(
      synthesis, "synthesis.guideWeight", tr("Guides' weight"),
      {.minimum = 10,
       .maximum = 10'000,
       .defaultValue = defaults.synthesis.guideWeight,
       .decimals = 0,
       .logarithmic = true},
      [](const LeafParameters& p) { return p.synthesis.guideWeight; },
      [](LeafParameters& p, double v) { p.synthesis.guideWeight = v; }));
  ofGuided.back()->setToolTip(
      tr("How much the place in the leaf counts beside the colours: more keeps veins, less keeps the grain"));
  const auto classic = [&](const char* name, const QString& label, const NumberSpec& spec, auto member,
                           const QString& help) {
    ofClassic.push_back(number(
        synthesis, name, label, spec, [member](const LeafParameters& p) { return double(p.synthesis.*member); },
        [member](LeafParameters& p, double v) {
          p.synthesis.*member = static_cast<std::remove_reference_t<decltype(p.synthesis.*member)>>(v);
        }));
    ofClassic.back()->setToolTip(help);
  };
  using Synthesis = model::SynthesisParameters;
  classic("synthesis.superpixels", tr("Superpixels"),
          {.minimum = 64,
           .maximum = 32768,
           .defaultValue = double(defaults.synthesis.superpixels),
           .decimals = 0,
           .logarithmic = true,
           .step = 64},
          &Synthesis::superpixels, tr("How many at the finest level"));
  classic("synthesis.levels", tr("Levels"),
          {.minimum = 1, .maximum = 5, .defaultValue = double(defaults.synthesis.levels), .decimals = 0},
          &Synthesis::levels, tr("Of superpixels, from coarse to fine; the thesis has five"));
  classic("synthesis.candidates", tr("Candidates"),
          {.minimum = 1, .maximum = 64, .defaultValue = double(defaults.synthesis.candidates), .decimals = 0},
          &Synthesis::candidates,
          tr("How many of the nearest superpixels one is drawn from: more, the more variants differ"));
  classic("synthesis.choices", tr("Drawn of them"),
          {.minimum = 1, .maximum = 16, .defaultValue = double(defaults.synthesis.choices), .decimals = 0},
          &Synthesis::choices,
          tr("So many are drawn, and the one whose colour is nearest to the coarser level's is taken"));
  classic("synthesis.smoothing", tr("Smoothing"),
          {.minimum = 0, .maximum = 4, .defaultValue = defaults.synthesis.smoothing}, &Synthesis::smoothing,
          tr("How much neighbouring superpixels blend"));
  ofClassic.push_back(flag(
      synthesis, "synthesis.detail", tr("Fine detail"), defaults.synthesis.detail,
      tr("Lays the photo's fine grain over the smooth colours"),
      [](const LeafParameters& p) { return p.synthesis.detail; },
      [](LeafParameters& p, bool on) { p.synthesis.detail = on; }));
  ofClassic.push_back(flag(
      synthesis, "synthesis.asThesis", tr("As in the thesis"), defaults.synthesis.asThesis,
      tr("Regions are matched by areas in pixels, places by structural distance alone"),
      [](const LeafParameters& p) { return p.synthesis.asThesis; },
      [](LeafParameters& p, bool on) { p.synthesis.asThesis = on; }));
  refreshers_.push_back([ofClassic, ofGuided](const model::Leaf& leaf) {
    const bool guided = leaf.parameters.synthesis.guided;
    for (QWidget* field : ofClassic) field->setVisible(!guided);
    for (QWidget* field : ofGuided) field->setVisible(guided);
  });
}

void LeafInspector::showFound(const model::LeafStages* stages) {
  const bool contour = stages && stages->reached >= model::Stage::Contour;
  const bool veins = stages && stages->reached >= model::Stage::Veins;
  vertices_->setValue(contour ? tr("%1 of %2 border pixels").arg(stages->contour.size()).arg(stages->border.size())
                              : QString());
  int byOrder[3] = {0, 0, 0};
  if (veins) {
    for (const model::Vein& vein : stages->veins) ++byOrder[std::clamp(vein.order, 1, 3) - 1];
  }
  veinsFound_->setValue(veins ? tr("%1 main, %2 lateral, %3 finer").arg(byOrder[0]).arg(byOrder[1]).arg(byOrder[2])
                              : QString());
  const model::Leaf* leaf = document_.project().leaf(leaf_);
  // With a ruler the length is measured, not given.
  const bool measured = leaf && leaf->ruler.isSet();
  bladeLength_->setEnabled(!measured);
  if (measured && contour) bladeLength_->setValue(100 * stages->bladeLength);
}

CheckField* LeafInspector::flag(FieldGroup* group, const char* id, const QString& label, bool defaultValue,
                                const QString& help, std::function<bool(const LeafParameters&)> get,
                                std::function<void(LeafParameters&, bool)> set) {
  auto* field = group->add(new CheckField(label, defaultValue));
  field->setToolTip(help);
  checks_.insert(QString::fromLatin1(id), field);
  connect(field, &CheckField::edited, this,
          [this, field, set = std::move(set)](bool on) { edit(field, [&](LeafParameters& p) { set(p, on); }); });
  refreshers_.push_back(
      [field, get = std::move(get)](const model::Leaf& leaf) { field->setValue(get(leaf.parameters)); });
  return field;
}

NumberField* LeafInspector::number(FieldGroup* group, const char* id, const QString& label, const NumberSpec& spec,
                                   std::function<double(const LeafParameters&)> get,
                                   std::function<void(LeafParameters&, double)> set) {
  auto* field = group->add(new NumberField(label, spec));
  numbers_.insert(QString::fromLatin1(id), field);
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
  if (!leaf->ruler.isSet()) {
    bladeLength_->setValue(100 * leaf->bladeLength);
    bladeLength_->setEnabled(true);
  }
  rulerLength_->setValue(100 * leaf->ruler.metres);
  rulerLength_->setEnabled(leaf->ruler.isSet());
  for (const auto& refreshRow : refreshers_) refreshRow(*leaf);
}

}  // namespace windfall::widgets
