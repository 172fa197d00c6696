#include "widgets/plant/growth_fields.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QPushButton>
#include <algorithm>

#include "model/source_file.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/plant/crown_editor.h"
#include "widgets/plant/rules_editor.h"

namespace windfall::widgets {

using model::GrowerSettings;
using model::GrowMethod;

GrowthFields::GrowthFields(model::Document& document, FieldPanel& panel, FieldGroup& general, QObject* parent)
    : QObject(parent), document_(document) {
  makeGeneral(general);
  makeCrown(panel);
  makeBranching(panel);
  makeCompetition(panel);
  makeRules(panel);
  makeFoliage(panel);
  makeWood(panel);
  show({});
}

void GrowthFields::edit(const Change& change, const QString& text, const QString& merge) {
  const model::Plant* plant = document_.project().plant(plant_);
  if (plant == nullptr || !plant->grower) return;
  std::optional<GrowerSettings> settings = plant->grower;
  change(*settings);
  document_.setPlant(plant_, &model::Plant::grower, settings, model::Aspect::PlantSource, text, merge);
}

template <class T>
NumberField* GrowthFields::number(FieldGroup* group, const QString& key, const QString& label, const NumberSpec& spec,
                                  Member<T> member, const QString& help) {
  auto* field = group->add(new NumberField(label, spec));
  field->setObjectName(key);
  if (!help.isEmpty()) field->setToolTip(help);
  connect(field, &NumberField::edited, this, [this, field, label, member](double value) {
    edit([&](GrowerSettings& g) { member(g) = static_cast<T>(value); }, tr("Change %1").arg(label.toLower()),
         field->gesture());
  });
  shows_.push_back([field, member](const GrowerSettings& now) {
    GrowerSettings copy = now;
    field->setValue(static_cast<double>(member(copy)));
  });
  return field;
}

template <class T>
ChoiceField* GrowthFields::choice(FieldGroup* group, const QString& key, const QString& label, const QStringList& names,
                                  Member<T> member) {
  auto* field = group->add(new ChoiceField(label, names, 0));
  field->setObjectName(key);
  connect(field, &ChoiceField::edited, this, [this, label, member](int index) {
    edit([&](GrowerSettings& g) { member(g) = static_cast<T>(index); }, tr("Change %1").arg(label.toLower()), {});
  });
  shows_.push_back([field, member](const GrowerSettings& now) {
    GrowerSettings copy = now;
    field->setValue(static_cast<int>(member(copy)));
  });
  return field;
}

void GrowthFields::check(FieldGroup* group, const QString& key, const QString& label, Member<bool> member,
                         const QString& help) {
  auto* field = group->add(new CheckField(label, false));
  field->setObjectName(key);
  field->setToolTip(help);
  connect(field, &CheckField::edited, this, [this, label, member](bool on) {
    edit([&](GrowerSettings& g) { member(g) = on; }, tr("Change %1").arg(label.toLower()), {});
  });
  shows_.push_back([field, member](const GrowerSettings& now) {
    GrowerSettings copy = now;
    field->setValue(member(copy));
  });
}

void GrowthFields::makeGeneral(FieldGroup& group) {
  choice<GrowMethod>(&group, "grower.method", tr("Method"),
                     {tr("Simple rule"), tr("Space colonization"), tr("Self-organizing"), tr("L-system")},
                     [](GrowerSettings& g) -> GrowMethod& { return g.method; });
  age_ = number<double>(
      &group, "grower.age", tr("Age"),
      {.maximum = 60, .defaultValue = 60, .decimals = 1, .unit = tr("years"), .hardMaximum = 10'000},
      [](GrowerSettings& g) -> double& { return g.age; },
      tr("How far the plant has grown; cuts and drawn branches grow on from when they were made"));
  number<double>(&group, "grower.maturity", tr("Full-grown at"),
                 {.minimum = 1,
                  .maximum = 200,
                  .defaultValue = 60,
                  .decimals = 1,
                  .unit = tr("years"),
                  .hardMinimum = 0.1,
                  .hardMaximum = 10'000},
                 [](GrowerSettings& g) -> double& { return g.maturity; });
}

void GrowthFields::makeCrown(FieldPanel& panel) {
  crown_ = panel.addGroup("crown", tr("Crown"));
  outline_ = new CrownEditor;
  outline_->setObjectName("crown.outline");
  crown_->addWidget(outline_);
  connect(outline_, &CrownEditor::edited, this, [this](const std::vector<QPointF>& profile, const QString& merge) {
    edit([&](GrowerSettings& g) { g.colonization.crown.profile = profile; },
         profile.empty() ? tr("Use the crown's formula") : tr("Draw the crown"), merge);
  });
  shows_.push_back([this](const GrowerSettings& now) { outline_->show(now.colonization.crown); });
  const auto field = [&](const char* key, const QString& label, const NumberSpec& spec, Member<double> member,
                         const QString& help = {}) { number<double>(crown_, key, label, spec, member, help); };
  field("crown.base", tr("Begins at"), {.maximum = 15, .defaultValue = 3.2, .unit = "m", .hardMaximum = 100},
        [](GrowerSettings& g) -> double& { return g.colonization.crown.base; });
  field("crown.radius", tr("Radius"),
        {.minimum = 0.2, .maximum = 12, .defaultValue = 5, .unit = "m", .hardMinimum = 0.01, .hardMaximum = 100},
        [](GrowerSettings& g) -> double& { return g.colonization.crown.radius; });
  field(
      "crown.widest", tr("Widest at"), {.defaultValue = 0.4},
      [](GrowerSettings& g) -> double& { return g.colonization.crown.widest; }, tr("Share of the crown's height"));
  field(
      "crown.lowPower", tr("Roundness below"),
      {.minimum = 0.5, .maximum = 5, .defaultValue = 1.9, .hardMinimum = 0.2, .hardMaximum = 20},
      [](GrowerSettings& g) -> double& { return g.colonization.crown.lowPower; }, tr("1 cone, 2 ellipsoid, 3 box"));
  field("crown.highPower", tr("Roundness above"),
        {.minimum = 0.5, .maximum = 5, .defaultValue = 2, .hardMinimum = 0.2, .hardMaximum = 20},
        [](GrowerSettings& g) -> double& { return g.colonization.crown.highPower; });
  number<int>(
      crown_, "crown.lobes", tr("Clumps"), {.maximum = 50, .defaultValue = 0, .decimals = 0, .hardMaximum = 1000},
      [](GrowerSettings& g) -> int& { return g.colonization.lobes; }, tr("Balls that the foliage gathers in; 0: even"));
  connect(crown_->addButton(tr("Fill a closed mesh…"), "import"), &QPushButton::clicked, this,
          &GrowthFields::importCrown);
  auto* none = crown_->addButton(tr("Take the mesh away"), "close");
  connect(none, &QPushButton::clicked, this, [this] {
    document_.setPlant(plant_, &model::Plant::crown, model::SourceFile{}, model::Aspect::PlantSource,
                       tr("Take the crown's mesh away"));
  });
  noMesh_ = none;
}

void GrowthFields::importCrown() {
  const QString path = QFileDialog::getOpenFileName(crown_, tr("Crown Mesh"), {},
                                                    tr("Meshes (%1)").arg("*.obj *.stl *.ply *.fbx *.glb *.gltf"));
  if (path.isEmpty()) return;
  Result<model::SourceFile> file = model::readSourceFile(path);
  if (!file) {
    emit problem(
        QStringLiteral("%1: %2").arg(QFileInfo(path).fileName(), QString::fromStdString(file.error().message)));
    return;
  }
  document_.setPlant(plant_, &model::Plant::crown, std::move(*file), model::Aspect::PlantSource,
                     tr("Fill a mesh with the crown"));
}

void GrowthFields::makeBranching(FieldPanel& panel) {
  branching_ = panel.addGroup("branching", tr("Branching"));
  const auto field = [&](const char* key, const QString& label, const NumberSpec& spec, Member<double> member,
                         const QString& help = {}) { number<double>(branching_, key, label, spec, member, help); };
  number<int>(
      branching_, "colony.points", tr("Points"),
      {.minimum = 200,
       .maximum = 20'000,
       .defaultValue = 9000,
       .decimals = 0,
       .logarithmic = true,
       .hardMinimum = 1,
       .hardMaximum = 400'000},
      [](GrowerSettings& g) -> int& { return g.colonization.points; },
      tr("Places in the crown that branches reach for"));
  field(
      "colony.trunkTop", tr("Trunk up to"), {.maximum = 20, .defaultValue = 4.6, .unit = "m", .hardMaximum = 120},
      [](GrowerSettings& g) -> double& { return g.colonization.trunkTop; },
      tr("Low: limbs leave from one region; high: a leader with side branches"));
  field("colony.trunkWander", tr("Trunk wanders"), {.defaultValue = 0.3, .hardMaximum = 10},
        [](GrowerSettings& g) -> double& { return g.colonization.trunkWander; });
  number<int>(branching_, "colony.stems", tr("Stems"),
              {.minimum = 1, .maximum = 8, .defaultValue = 1, .decimals = 0, .hardMaximum = 64},
              [](GrowerSettings& g) -> int& { return g.colonization.stems; });
  field("colony.step", tr("Link length"),
        {.minimum = 0.05, .maximum = 0.6, .defaultValue = 0.2, .unit = "m", .hardMinimum = 0.01, .hardMaximum = 10},
        [](GrowerSettings& g) -> double& { return g.colonization.step; });
  field(
      "colony.influence", tr("Reach"),
      {.minimum = 0.5, .maximum = 6, .defaultValue = 2.6, .unit = "m", .hardMinimum = 0.05, .hardMaximum = 100},
      [](GrowerSettings& g) -> double& { return g.colonization.influence; }, tr("How far a point attracts"));
  field(
      "colony.kill", tr("Spacing"),
      {.minimum = 0.1, .maximum = 1.5, .defaultValue = 0.4, .unit = "m", .hardMinimum = 0, .hardMaximum = 50},
      [](GrowerSettings& g) -> double& { return g.colonization.kill; }, tr("Smaller makes more twigs"));
  field("colony.upward", tr("Upwards"),
        {.minimum = -0.5, .maximum = 1.5, .defaultValue = 0.06, .hardMinimum = -10, .hardMaximum = 10},
        [](GrowerSettings& g) -> double& { return g.colonization.upward; });
  field("colony.noise", tr("Crooked"), {.defaultValue = 0.3, .hardMaximum = 10},
        [](GrowerSettings& g) -> double& { return g.colonization.noise; });
  field(
      "colony.hangingLength", tr("Hanging shoots"), {.maximum = 6, .defaultValue = 0, .unit = "m", .hardMaximum = 50},
      [](GrowerSettings& g) -> double& { return g.colonization.hangingLength; },
      tr("Length of the shoots that weep from the tips"));
}

void GrowthFields::makeCompetition(FieldPanel& panel) {
  competition_ = panel.addGroup("competition", tr("Competition for light"));
  const auto field = [&](const char* key, const QString& label, const NumberSpec& spec, Member<double> member,
                         const QString& help = {}) { number<double>(competition_, key, label, spec, member, help); };
  choice<model::ResourceModel>(competition_, "light.model", tr("Resources"),
                               {tr("Borchert-Honda"), tr("Priority"), tr("Combined")},
                               [](GrowerSettings& g) -> model::ResourceModel& { return g.selfOrganizing.model; });
  field(
      "light.leader", tr("Shrub – tree"),
      {.minimum = 0.4, .maximum = 0.6, .defaultValue = 0.52, .hardMinimum = 0, .hardMaximum = 1},
      [](GrowerSettings& g) -> double& { return g.selfOrganizing.leader; }, tr("How much the main shoot is favoured"));
  field("light.vigour", tr("Vigour"),
        {.minimum = 1, .maximum = 5, .defaultValue = 2.2, .hardMinimum = 0, .hardMaximum = 100},
        [](GrowerSettings& g) -> double& { return g.selfOrganizing.vigour; });
  field(
      "light.density", tr("Shade"),
      {.minimum = 0.02, .maximum = 0.3, .defaultValue = 0.045, .decimals = 3, .hardMinimum = 0, .hardMaximum = 10},
      [](GrowerSettings& g) -> double& { return g.selfOrganizing.density; },
      tr("That a shoot casts; more makes a thinner plant"));
  field(
      "light.pruning", tr("Self-pruning"), {.maximum = 0.4, .defaultValue = 0.14, .hardMaximum = 100},
      [](GrowerSettings& g) -> double& { return g.selfOrganizing.pruning; },
      tr("Branches with too little light for their size die"));
  field("light.rate", tr("Growth rate"),
        {.minimum = 0.02,
         .maximum = 0.5,
         .defaultValue = 0.1,
         .decimals = 3,
         .unit = tr("/year"),
         .hardMinimum = 1e-4,
         .hardMaximum = 10},
        [](GrowerSettings& g) -> double& { return g.selfOrganizing.rate; });
  field("light.internode", tr("Internode"),
        {.minimum = 0.05, .maximum = 0.6, .defaultValue = 0.22, .unit = "m", .hardMinimum = 0.005, .hardMaximum = 5},
        [](GrowerSettings& g) -> double& { return g.selfOrganizing.internode; });
  choice<model::BudArrangement>(
      competition_, "light.arrangement", tr("Buds"), {tr("Alternate"), tr("Opposite"), tr("Whorled")},
      [](GrowerSettings& g) -> model::BudArrangement& { return g.selfOrganizing.arrangement; });
  number<int>(competition_, "light.buds", tr("Buds at a node"),
              {.minimum = 1, .maximum = 6, .defaultValue = 1, .decimals = 0, .hardMaximum = 12},
              [](GrowerSettings& g) -> int& { return g.selfOrganizing.buds; });
  number<int>(
      competition_, "light.basalBuds", tr("Buds at the ground"),
      {.maximum = 16, .defaultValue = 0, .decimals = 0, .hardMaximum = 30},
      [](GrowerSettings& g) -> int& { return g.selfOrganizing.basalBuds; }, tr("For bushes"));
  field("light.angle", tr("Branching angle"),
        {.minimum = 10,
         .maximum = 90,
         .defaultValue = 42,
         .decimals = 0,
         .unit = "°",
         .hardMinimum = 0,
         .hardMaximum = 180},
        [](GrowerSettings& g) -> double& { return g.selfOrganizing.angle; });
  field("light.light", tr("To the light"), {.maximum = 0.6, .defaultValue = 0.12, .hardMaximum = 10},
        [](GrowerSettings& g) -> double& { return g.selfOrganizing.light; });
  field("light.upward", tr("Upwards"),
        {.minimum = -0.3, .maximum = 0.6, .defaultValue = 0.05, .hardMinimum = -10, .hardMaximum = 10},
        [](GrowerSettings& g) -> double& { return g.selfOrganizing.upward; });
  field(
      "light.level", tr("Level"), {.defaultValue = 0, .hardMaximum = 10},
      [](GrowerSettings& g) -> double& { return g.selfOrganizing.level; }, tr("Side branches keep level"));
  check(
      competition_, "light.sprays", tr("Flat sprays"),
      [](GrowerSettings& g) -> bool& { return g.selfOrganizing.sprays; }, tr("Side shoots lie left and right"));
  field(
      "light.bole", tr("Bare bole"), {.defaultValue = 0},
      [](GrowerSettings& g) -> double& { return g.selfOrganizing.bole; },
      tr("Share of the height below which limbs die"));
  field(
      "light.reach", tr("Reach"),
      {.minimum = 0.1, .maximum = 1, .defaultValue = 0.6, .hardMinimum = 0, .hardMaximum = 10},
      [](GrowerSettings& g) -> double& { return g.selfOrganizing.reach; }, tr("Of branches, as a share of the height"));
}

void GrowthFields::makeRules(FieldPanel& panel) {
  rulesGroup_ = panel.addGroup("rules", tr("Rules"));
  rules_ = new RulesEditor;
  rules_->setObjectName("rules.text");
  rulesGroup_->addWidget(rules_);
  connect(rules_, &RulesEditor::edited, this, [this](const QString& text, const QString& merge) {
    edit([&](GrowerSettings& g) { g.lSystem.rules = text; }, tr("Change the rules"), merge);
  });
  shows_.push_back([this](const GrowerSettings& now) { rules_->show(now.lSystem.rules); });
  number<int>(
      rulesGroup_, "rules.iterations", tr("Generations"),
      {.maximum = 40, .defaultValue = 0, .decimals = 0, .hardMaximum = 1000},
      [](GrowerSettings& g) -> int& { return g.lSystem.iterations; }, tr("0: as the rules say"));
}

void GrowthFields::makeFoliage(FieldPanel& panel) {
  foliage_ = panel.addGroup("foliage", tr("Leaves of the species"));
  check(
      foliage_, "foliage.leaves", tr("In leaf"), [](GrowerSettings& g) -> bool& { return g.foliage.leaves; },
      tr("Off: bare, as in winter"));
  choice<model::LeafLook>(foliage_, "foliage.look", tr("Kind"),
                          {tr("Ovate"), tr("Oak"), tr("Birch"), tr("Aspen"), tr("Willow"), tr("Maple"), tr("Fir"),
                           tr("Pine"), tr("Bush"), tr("Herb")},
                          [](GrowerSettings& g) -> model::LeafLook& { return g.foliage.look; });
  number<double>(foliage_, "foliage.length", tr("Length"),
                 {.minimum = 0.02,
                  .maximum = 0.3,
                  .defaultValue = 0.08,
                  .decimals = 3,
                  .unit = "m",
                  .hardMinimum = 0.001,
                  .hardMaximum = 10},
                 [](GrowerSettings& g) -> double& { return g.foliage.length; });
  number<double>(foliage_, "foliage.amount", tr("Amount"),
                 {.maximum = 2, .defaultValue = 1, .unit = "×", .hardMaximum = 100},
                 [](GrowerSettings& g) -> double& { return g.foliage.amount; });
  number<int>(foliage_, "foliage.cluster", tr("On a shoot"),
              {.minimum = 1, .maximum = 12, .defaultValue = 6, .decimals = 0, .hardMaximum = 64},
              [](GrowerSettings& g) -> int& { return g.foliage.cluster; });
  number<double>(
      foliage_, "foliage.leafyLength", tr("From the tips"),
      {.maximum = 6, .defaultValue = 1.2, .unit = "m", .hardMaximum = 100},
      [](GrowerSettings& g) -> double& { return g.foliage.leafyLength; }, tr("How far down the twigs leaves stand"));
  choice<model::LeafArrangement>(foliage_, "foliage.arrangement", tr("Arrangement"),
                                 {tr("Alternate"), tr("Opposite"), tr("Two ranks")},
                                 [](GrowerSettings& g) -> model::LeafArrangement& { return g.foliage.arrangement; });
  number<double>(foliage_, "foliage.droop", tr("Droop"),
                 {.minimum = -0.5, .maximum = 1.5, .defaultValue = 0.3, .hardMinimum = -5, .hardMaximum = 5},
                 [](GrowerSettings& g) -> double& { return g.foliage.droop; });
}

void GrowthFields::makeWood(FieldPanel& panel) {
  wood_ = panel.addGroup("wood", tr("Wood"));
  choice<model::BarkLook>(wood_, "wood.bark", tr("Bark"),
                          {tr("Plain"), tr("Oak"), tr("Birch"), tr("Aspen"), tr("Willow"), tr("Maple"), tr("Fir"),
                           tr("Pine"), tr("Bush"), tr("Herb"), tr("Dead wood")},
                          [](GrowerSettings& g) -> model::BarkLook& { return g.wood.bark; });
  number<double>(wood_, "wood.tipRadius", tr("Tips' radius"),
                 {.minimum = 0.0005,
                  .maximum = 0.01,
                  .defaultValue = 0.0025,
                  .decimals = 4,
                  .unit = "m",
                  .hardMinimum = 1e-4,
                  .hardMaximum = 0.5},
                 [](GrowerSettings& g) -> double& { return g.wood.tipRadius; });
  number<double>(
      wood_, "wood.breakage", tr("Broken"), {.maximum = 0.2, .defaultValue = 0, .decimals = 3, .hardMaximum = 1},
      [](GrowerSettings& g) -> double& { return g.wood.breakage; }, tr("Share of the twigs that fell"));
}

void GrowthFields::show(model::AssetId shown) {
  plant_ = shown;
  const model::Plant* plant = document_.project().plant(shown);
  const bool grown = plant != nullptr && plant->grower.has_value() && plant->file.isEmpty();
  const GrowMethod method = grown ? plant->grower->method : GrowMethod::Rule;
  crown_->setVisible(grown && method == GrowMethod::SpaceColonization);
  branching_->setVisible(crown_->isVisibleTo(crown_->parentWidget()));
  competition_->setVisible(grown && method == GrowMethod::SelfOrganizing);
  rulesGroup_->setVisible(grown && method == GrowMethod::LSystem);
  foliage_->setVisible(grown && method != GrowMethod::Rule);
  wood_->setVisible(grown && method != GrowMethod::Rule);
  emit methodShown(method == GrowMethod::Rule);
  if (!grown) return;
  noMesh_->setVisible(!plant->crown.isEmpty());
  outline_->setEnabled(plant->crown.isEmpty());
  const double most = std::max(1.0, 1.5 * plant->grower->maturity);
  age_->setSpec({.maximum = most,
                 .defaultValue = plant->grower->maturity,
                 .decimals = most < 5 ? 2 : 1,
                 .unit = tr("years"),
                 .hardMaximum = 10'000});
  age_->setVisible(method != GrowMethod::Rule);
  for (const auto& showField : shows_) showField(*plant->grower);
}

}  // namespace windfall::widgets
