// Pins, Rayleigh damping and the clipboard of the chosen branches.
#include <QClipboard>
#include <QGuiApplication>
#include <QJsonDocument>
#include <QLocale>
#include <algorithm>

#include "model/document/project_fields.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/plant/branch_attributes.h"
#include "widgets/plant/link_choice.h"

namespace windfall::widgets {

using model::LinkAttributes;

namespace {
const QLatin1String kClipboard("windfallBranch");
}

void BranchAttributes::addPinned(FieldGroup* group) {
  auto* field = group->add(new CheckField(tr("Pinned"), false));
  field->setObjectName("link.pinned");
  field->setToolTip(tr("Stands still, with all that carries it (Shift+P)"));
  connect(field, &CheckField::edited, this, [this](bool on) {
    edit([&](LinkAttributes& a) { a.pinned = on; }, on ? tr("Pin branches") : tr("Let branches go"), {});
  });
  shows_.push_back([field](const std::vector<LinkAttributes>& all) {
    field->setValue(all.front().pinned);
    if (std::any_of(all.begin(), all.end(), [&](const LinkAttributes& a) { return a.pinned != all.front().pinned; })) {
      field->setMixed();
    }
  });
}

void BranchAttributes::addAdvanced() {
  FieldGroup* group = panel_.addGroup("rayleigh", tr("Rayleigh damping"));
  groups_.push_back(group);
  number(
      group, "link.rayleighAlpha", tr("Alpha"),
      {.maximum = 2, .defaultValue = 0, .decimals = 3, .unit = "1/s", .hardMaximum = 1000},
      tr("Damping by mass, beside the damping above: slows slow sway most"),
      [](const LinkAttributes& a) { return a.rayleighAlpha; },
      [](LinkAttributes& a, double v) { a.rayleighAlpha = v; });
  number(
      group, "link.rayleighBeta", tr("Beta"),
      {.maximum = 0.1, .defaultValue = 0, .decimals = 4, .unit = "s", .hardMaximum = 100},
      tr("Damping by stiffness, beside the damping above: slows fast trembling most"),
      [](const LinkAttributes& a) { return a.rayleighBeta; }, [](LinkAttributes& a, double v) { a.rayleighBeta = v; });
  number(
      group, "link.propagation", tr("Propagation"), {.maximum = 1, .defaultValue = 0.8},
      tr("Of the forces method only: the share of a child's bending that reaches its parent"),
      [](const LinkAttributes& a) { return a.propagation; }, [](LinkAttributes& a, double v) { a.propagation = v; });
}

void BranchAttributes::showFrequency() {
  if (!tree_ || links_.empty()) return;
  const double frequency = branchFrequency(*tree_, links_.back());
  frequency_->setValue(frequency > 0 ? tr("%1 Hz").arg(QLocale().toString(frequency, 'f', frequency < 10 ? 2 : 1))
                                     : tr("none"));
}

void BranchAttributes::copy() const {
  const model::Plant* plant = document_.project().plant(plant_);
  if (plant == nullptr || links_.empty()) return;
  const auto found = plant->edits.find(boneName(links_.front()));
  model::WriteContext context;
  model::FieldWriter io(context, {});
  model::fields(io, found == plant->edits.end() ? LinkAttributes{} : found->second);
  const QJsonObject object{{kClipboard, io.take()}};
  QGuiApplication::clipboard()->setText(QString::fromUtf8(QJsonDocument(object).toJson(QJsonDocument::Compact)));
}

void BranchAttributes::paste() {
  const QByteArray text = QGuiApplication::clipboard()->text().left(10'000).toUtf8();
  const QJsonValue values = QJsonDocument::fromJson(text).object().value(kClipboard);
  if (!values.isObject()) return;
  model::ReadContext context;
  model::FieldReader io(context, values.toObject(), {});
  LinkAttributes pasted;
  model::fields(io, pasted);
  if (!context.error.isEmpty()) return;
  edit([&](LinkAttributes& a) { a = pasted; }, tr("Paste values to branches"), {});
}

void BranchAttributes::togglePinned() {
  const model::Plant* plant = document_.project().plant(plant_);
  if (plant == nullptr || links_.empty()) return;
  const bool all = std::all_of(links_.begin(), links_.end(), [&](std::size_t link) {
    const auto found = plant->edits.find(boneName(link));
    return found != plant->edits.end() && found->second.pinned;
  });
  edit([&](LinkAttributes& a) { a.pinned = !all; }, all ? tr("Let branches go") : tr("Pin branches"), {});
}

}  // namespace windfall::widgets
