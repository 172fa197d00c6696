#include "widgets/plant/branch_attributes.h"

#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QTimer>
#include <algorithm>

#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/plant/link_choice.h"

namespace windfall::widgets {

using model::LinkAttributes;

BranchAttributes::BranchAttributes(model::Document& document, FieldPanel& panel, QObject* parent)
    : QObject(parent), document_(document), panel_(panel), nothing_(new QLabel), frequencyTimer_(new QTimer(this)) {
  nothing_->setText(tr("Click a branch in the view, or choose one in the list."));
  nothing_->setProperty("hint", true);
  nothing_->setWordWrap(true);
  nothing_->setContentsMargins(8, 8, 8, 8);
  panel.addWidget(nothing_);

  const auto add = [&](const QString& id, const QString& title) {
    groups_.push_back(panel.addGroup(id, title));
    return groups_.back();
  };
  FieldGroup* geometry = add("geometry", tr("Geometry"));
  what_ = geometry->add(new InfoField(tr("Chosen")));
  what_->setObjectName("branch.chosen");
  length_ = geometry->add(new InfoField(tr("Length")));
  length_->setObjectName("branch.length");
  radius_ = geometry->add(new InfoField(tr("Radius")));
  order_ = geometry->add(new InfoField(tr("Order")));

  FieldGroup* mass = add("mass", tr("Mass"));
  number(
      mass, "link.woodDensity", tr("Wood density"),
      {.minimum = 200,
       .maximum = 1300,
       .defaultValue = 950,
       .decimals = 0,
       .unit = "kg/m³",
       .hardMinimum = 20,
       .hardMaximum = 5000},
      tr("Green wood with its water"), [](const LinkAttributes& a) { return a.woodDensity; },
      [](LinkAttributes& a, double v) { a.woodDensity = v; });
  wood_ = mass->add(new InfoField(tr("Wood")));
  wood_->setObjectName("branch.wood");
  leafMass_ = mass->add(new InfoField(tr("Leaves")));

  FieldGroup* stiffness = add("stiffness", tr("Stiffness and damping"));
  number(
      stiffness, "link.stiffness", tr("Stiffness"),
      {.minimum = 0.05,
       .maximum = 20,
       .defaultValue = 1,
       .unit = "×",
       .logarithmic = true,
       .hardMinimum = 0.001,
       .hardMaximum = 1000},
      tr("Times what length, radius and wood give"), [](const LinkAttributes& a) { return a.stiffness; },
      [](LinkAttributes& a, double v) { a.stiffness = v; });
  number(
      stiffness, "link.damping", tr("Damping"),
      {.minimum = 0.05,
       .maximum = 20,
       .defaultValue = 1,
       .unit = "×",
       .logarithmic = true,
       .hardMinimum = 0.001,
       .hardMaximum = 1000},
      tr("How soon the sway dies away"), [](const LinkAttributes& a) { return a.damping; },
      [](LinkAttributes& a, double v) { a.damping = v; });
  number(
      stiffness, "link.youngsModulus", tr("Young's modulus"),
      {.minimum = 0.5, .maximum = 20, .defaultValue = 6, .unit = "GPa", .hardMinimum = 0.01, .hardMaximum = 500},
      tr("Stiffness of the wood itself"), [](const LinkAttributes& a) { return a.youngsModulus / 1e9; },
      [](LinkAttributes& a, double v) { a.youngsModulus = v * 1e9; });

  frequency_ = stiffness->add(new InfoField(tr("Frequency")));
  frequency_->setObjectName("branch.frequency");
  frequency_->setToolTip(
      tr("How often the branch that was chosen last sways with all that it carries, by calculation"));
  addPinned(stiffness);
  // Not at every step of a slider: a trunk carries thousands of links.
  frequencyTimer_->setSingleShot(true);
  frequencyTimer_->setInterval(120);
  connect(frequencyTimer_, &QTimer::timeout, this, &BranchAttributes::showFrequency);
  addAdvanced();

  FieldGroup* wind = add("wind", tr("Wind"));
  number(
      wind, "link.windResponse", tr("Response"), {.maximum = 4, .defaultValue = 1, .unit = "×", .hardMaximum = 100},
      tr("Times the wind's force on wood and leaves"), [](const LinkAttributes& a) { return a.windResponse; },
      [](LinkAttributes& a, double v) { a.windResponse = v; });

  FieldGroup* leaves = add("leaves", tr("Leaves of the chosen"));
  leafCount_ = leaves->add(new InfoField(tr("Places")));
  leafArea_ = leaves->add(new InfoField(tr("Area")));
  resetAll_ = leaves->addButton(tr("Reset the chosen to defaults"), "reset");
  resetAll_->setObjectName("branch.reset");
  connect(resetAll_, &QPushButton::clicked, this,
          [this] { edit([](LinkAttributes& a) { a = {}; }, tr("Reset branches"), {}); });
  show({}, {}, nullptr, {}, 0);
}

const QString& BranchAttributes::boneName(std::size_t link) const {
  return loaded_.geometry->bones[static_cast<std::size_t>(loaded_.bodies->boneOfLink[link])].name;
}

void BranchAttributes::number(FieldGroup* group, const QString& key, const QString& label, const NumberSpec& spec,
                              const QString& toolTip, Get get, Set set) {
  auto* field = group->add(new NumberField(label, spec));
  field->setObjectName(key);
  field->setToolTip(toolTip);
  connect(field, &NumberField::edited, this, [this, field, label, set](double value) {
    edit([&](LinkAttributes& a) { set(a, value); }, tr("Change %1").arg(label.toLower()), field->gesture());
  });
  shows_.push_back([field, get](const std::vector<LinkAttributes>& all) {
    field->setValue(get(all.front()));
    if (std::any_of(all.begin(), all.end(), [&](const LinkAttributes& a) { return get(a) != get(all.front()); })) {
      field->setMixed();
    }
  });
}

void BranchAttributes::edit(const std::function<void(LinkAttributes&)>& change, const QString& text,
                            const QString& merge) {
  const model::Plant* plant = document_.project().plant(plant_);
  if (plant == nullptr || links_.empty()) return;
  std::map<QString, LinkAttributes> edits = plant->edits;
  for (const std::size_t link : links_) {
    LinkAttributes& attributes = edits[boneName(link)];
    change(attributes);
    if (attributes == LinkAttributes{}) edits.erase(boneName(link));
  }
  document_.setPlant(plant_, &model::Plant::edits, edits, model::Aspect::PlantEdits, text, merge);
}

void BranchAttributes::show(model::AssetId plant, const model::LoadedPlant& loaded,
                            std::shared_ptr<const sim::Tree> tree, std::vector<std::size_t> links,
                            std::size_t branches) {
  plant_ = plant;
  loaded_ = loaded;
  tree_ = std::move(tree);
  links_ = std::move(links);
  const model::Plant* asset = document_.project().plant(plant_);
  const bool any = asset != nullptr && loaded_.geometry && tree_ && !links_.empty();
  nothing_->setVisible(!any);
  for (FieldGroup* group : groups_) group->setVisible(any);
  if (!any) return;
  std::vector<LinkAttributes> all;
  all.reserve(links_.size());
  for (const std::size_t link : links_) {
    const auto found = asset->edits.find(boneName(link));
    all.push_back(found == asset->edits.end() ? LinkAttributes{} : found->second);
  }
  for (const auto& showField : shows_) showField(all);
  frequencyTimer_->start();
  resetAll_->setEnabled(
      std::any_of(all.begin(), all.end(), [](const LinkAttributes& a) { return a != LinkAttributes{}; }));
  showMeasures(branches);
}

void BranchAttributes::showMeasures(std::size_t branches) {
  const QLocale locale;
  const auto text = [&](double value, int decimals, const QString& unit) {
    return QStringLiteral("%1 %2").arg(locale.toString(value, 'f', decimals), unit);
  };
  double length = 0, thinnest = 1e30, thickest = 0, wood = 0, leafMass = 0, area = 0;
  int lowest = tree_->links[links_.front()].order, highest = lowest;
  std::vector<bool> isChosen(tree_->links.size(), false);
  for (const std::size_t i : links_) {
    const sim::Link& link = tree_->links[i];
    const sim::LinkMass mass = sim::massOf(link);
    isChosen[i] = true;
    length += static_cast<double>(link.length);
    thinnest = std::min(thinnest, static_cast<double>(link.radius));
    thickest = std::max(thickest, static_cast<double>(link.radius));
    lowest = std::min(lowest, link.order);
    highest = std::max(highest, link.order);
    wood += static_cast<double>(mass.wood);
    leafMass += static_cast<double>(mass.leaves);
    area += static_cast<double>(link.leafArea);
  }
  const auto places = std::count_if(tree_->sites.begin(), tree_->sites.end(), [&](const sim::LeafSite& site) {
    return isChosen[static_cast<std::size_t>(site.link)];
  });
  const QString bones =
      links_.size() == 1 ? tr("1 link") : tr("%1 links").arg(locale.toString(static_cast<qulonglong>(links_.size())));
  what_->setValue(branches > 1 ? tr("%1 branches, %2").arg(locale.toString(static_cast<qulonglong>(branches)), bones)
                               : bones);
  length_->setValue(text(length, 2, tr("m")));
  const bool thin = thickest < 0.1;
  const double scale = thin ? 1000 : 100;
  const QString unit = thin ? tr("mm") : tr("cm");
  radius_->setValue(
      thickest - thinnest < 1e-6
          ? text(thickest * scale, 1, unit)
          : tr("%1 to %2").arg(locale.toString(thinnest * scale, 'f', 1), text(thickest * scale, 1, unit)));
  order_->setValue(lowest == highest ? locale.toString(lowest) : tr("%1 to %2").arg(lowest).arg(highest));
  wood_->setValue(wood < 1 ? text(wood * 1000, 1, tr("g")) : text(wood, 2, tr("kg")));
  leafMass_->setValue(leafMass < 1 ? text(leafMass * 1000, 1, tr("g")) : text(leafMass, 2, tr("kg")));
  leafCount_->setValue(locale.toString(static_cast<qlonglong>(places)));
  leafArea_->setValue(area < 0.1 ? text(area * 1e4, 1, tr("cm²")) : text(area, 2, tr("m²")));
}

}  // namespace windfall::widgets
