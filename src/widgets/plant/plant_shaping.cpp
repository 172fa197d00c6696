#include "widgets/plant/plant_shaping.h"

#include <QPushButton>
#include <algorithm>
#include <glm/common.hpp>

#include "model/plant/frames.h"
#include "model/plant/import.h"
#include "widgets/fields/choice_field.h"
#include "widgets/look/tool_action.h"
#include "widgets/viewport/viewport.h"

namespace windfall::widgets {

PlantShaping::PlantShaping(const Surroundings& around, QAction* select, ViewportTool& selectTool, FieldPanel& panel,
                           QObject* parent)
    : QObject(parent), around_(around), tools_(makeShapeTools(*this)), select_(select), group_(this) {
  const auto activate = [this](QAction* action, ViewportTool* tool, const QString& help) {
    connect(action, &QAction::toggled, this, [this, tool, help](bool on) {
      if (!on) return;
      around_.viewport.setTool(tool);
      around_.viewport.update();
      emit status(help);
    });
    group_.addAction(action);
  };
  activate(select, &selectTool, select->statusTip());
  for (const std::unique_ptr<ShapeTool>& tool : tools_) {
    QAction* action = toolAction(this, tool->id(), tool->title(), tool->help(), tool->shortcut());
    action->setObjectName(QStringLiteral("shape.") + tool->id());
    activate(action, tool.get(), tool->help());
    // The plant is shaped as it stands at rest.
    connect(action, &QAction::toggled, this, [this](bool on) {
      if (on) around_.controller.pause();
    });
    actions_.push_back(action);
  }
  parts_ = panel.addGroup("parts", tr("By hand"));
  count_ = parts_->add(new InfoField(tr("Edits")));
  count_->setObjectName("shape.edits");
  connect(parts_->addButton(tr("Take all edits back"), "reset"), &QPushButton::clicked, this, [this] {
    document().setPlant(plant(), &model::Plant::handEdits, std::vector<model::HandEdit>{}, model::Aspect::PlantSource,
                        tr("Take back what was shaped by hand"));
  });
  choice_ = parts_->add(new ChoiceField(tr("Part"), {}, 0));
  choice_->setObjectName("shape.part");
  choice_->setToolTip(tr("The part that “Set a part on” uses"));
  auto* keep = parts_->addButton(tr("Keep the chosen branch as a part"), "save");
  keep->setObjectName("shape.keepPart");
  connect(keep, &QPushButton::clicked, this, &PlantShaping::keepPart);
  connect(parts_->addButton(tr("Forget this part"), "delete"), &QPushButton::clicked, this, [this] {
    if (const model::PlantPart* chosen = part()) {
      const QString name = chosen->name;
      if (const Status removed = library_.remove(name); !removed)
        emit message(QString::fromStdString(removed.error().message), true);
      listParts();
    }
  });
  listParts();
}

void PlantShaping::setPartFolder(const QString& folder) {
  library_ = model::PartLibrary(folder);
  listParts();
}

void PlantShaping::listParts() {
  const QSignalBlocker blocker(choice_->box());
  const int before = choice_->box()->currentIndex();
  choice_->box()->clear();
  for (const model::PlantPart& part : library_.parts()) choice_->box()->addItem(part.name);
  choice_->setVisible(!library_.parts().empty());
  choice_->setValue(std::clamp(before, 0, std::max(0, static_cast<int>(library_.parts().size()) - 1)));
}

const model::PlantPart* PlantShaping::part() const {
  const int index = choice_->box()->currentIndex();
  return index >= 0 && index < static_cast<int>(library_.parts().size())
             ? &library_.parts()[static_cast<std::size_t>(index)]
             : nullptr;
}

void PlantShaping::keepPart() {
  const model::LoadedPlant loaded = around_.loaded();
  const std::vector<std::size_t> links = around_.chosenLinks();
  const model::Plant* shown = document().project().plant(plant());
  if (!loaded.geometry || links.empty() || shown == nullptr) {
    emit message(tr("Choose a branch first."), false);
    return;
  }
  // The chosen link that is nearest the root begins the part: links stand in depth-first order.
  const auto bone = static_cast<std::size_t>(loaded.bodies->boneOfLink[links.front()]);
  model::PlantPart part = model::partOf(loaded.geometry->bones, bone,
                                        QStringLiteral("%1, %2").arg(shown->name, loaded.geometry->bones[bone].name));
  if (const Status saved = library_.save(part); !saved) {
    emit message(QString::fromStdString(saved.error().message), true);
    return;
  }
  listParts();
  choice_->setValue(static_cast<int>(library_.parts().size()) - 1);
  emit message(tr("Kept “%1” as a part.").arg(part.name), false);
}

void PlantShaping::show() {
  const model::Plant* shown = document().project().plant(plant());
  const bool shapeable = shown != nullptr && model::canBeShaped(*shown);
  parts_->setVisible(shown != nullptr);
  count_->setValue(!shapeable ? tr("none: neither grown nor a skeleton")
                              : tr("%n", nullptr, static_cast<int>(shown->handEdits.size())));
  for (QAction* action : actions_) {
    if (!shapeable && action->isChecked()) select_->setChecked(true);
    action->setEnabled(shapeable);
  }
}

const model::PlantGeometry* PlantShaping::shapeable() {
  const model::Plant* shown = document().project().plant(plant());
  if (shown == nullptr || !model::canBeShaped(*shown)) return nullptr;
  // What is being grown anew has other bones than what is seen.
  if (around_.feed.isAssembling()) return nullptr;
  held_ = around_.loaded();
  return held_.geometry.get();
}

std::optional<PickedBone> PlantShaping::boneAt(const ViewportEvent& event) {
  const model::PlantGeometry* geometry = shapeable();
  if (geometry == nullptr) return {};
  const Ray ray = event.camera.ray(event.position, event.size);
  const auto hit = pick(ray, around_.feed.capsules(), around_.feed.restPose(), pickSlack(event));
  if (!hit || hit->link >= held_.bodies->boneOfLink.size()) return {};
  PickedBone picked;
  picked.bone = static_cast<std::size_t>(held_.bodies->boneOfLink[hit->link]);
  const model::Bone& bone = geometry->bones[picked.bone];
  picked.share = model::closestShare(bone.head, bone.tail, ray.origin + hit->distance * ray.direction);
  picked.place = glm::mix(bone.head, bone.tail, picked.share);
  return picked;
}

void PlantShaping::highlight(const std::vector<std::size_t>& bones) {
  std::vector<std::uint32_t> links;
  if (held_.bodies) {
    for (const std::size_t bone : bones) {
      const int link = bone < held_.bodies->linkOfBone.size() ? held_.bodies->linkOfBone[bone] : -1;
      if (link >= 0) links.push_back(static_cast<std::uint32_t>(link));
    }
  }
  around_.controller.setHighlighted(std::move(links));
  around_.viewport.update();
}

}  // namespace windfall::widgets
