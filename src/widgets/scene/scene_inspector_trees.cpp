// The chosen trees and the device: the groups of the scene's inspector that are not plain numbers of the scene.
#include <QLabel>
#include <QPushButton>
#include <algorithm>

#include "widgets/fields/choice_field.h"
#include "widgets/fields/dial_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/scene/scene_inspector.h"

namespace windfall::widgets {

using model::TreePlacement;

std::vector<const TreePlacement*> SceneInspector::chosen() const {
  std::vector<const TreePlacement*> trees;
  for (const TreePlacement& tree : document_.project().scene.trees) {
    if (selection_.contains(tree.id)) trees.push_back(&tree);
  }
  return trees;
}

void SceneInspector::editTrees(const std::function<void(TreePlacement&)>& edit, const QString& text,
                               const QString& merge) {
  std::vector<TreePlacement> trees = document_.project().scene.trees;
  for (TreePlacement& tree : trees) {
    if (selection_.contains(tree.id)) edit(tree);
  }
  document_.setScene(&model::Scene::trees, trees, model::Aspect::SceneTrees, text, merge);
}

NumberField* SceneInspector::treeNumber(const QString& key, const QString& label, const NumberSpec& spec,
                                        std::function<double(const TreePlacement&)> get,
                                        std::function<void(TreePlacement&, double)> set) {
  auto* field = trees_->add(new NumberField(label, spec));
  keep(key, field);
  treeRows_.push_back(field);
  connect(field, &NumberField::edited, this, [this, field, label, set](double value) {
    editTrees([&](TreePlacement& tree) { set(tree, value); }, tr("Change %1 of trees").arg(label.toLower()),
              field->gesture());
  });
  treeShows_.push_back([field, get](const std::vector<const TreePlacement*>& trees) {
    field->setValue(get(*trees.front()));
    if (std::any_of(trees.begin(), trees.end(),
                    [&](const TreePlacement* t) { return get(*t) != get(*trees.front()); })) {
      field->setMixed();
    }
  });
  return field;
}

void SceneInspector::addTrees() {
  trees_ = addGroup("trees", tr("Chosen trees"));
  noTree_ = new QLabel(tr("Click a tree in the view to choose it."));
  noTree_->setProperty("hint", true);
  noTree_->setWordWrap(true);
  trees_->addWidget(noTree_);
  plant_ = trees_->add(new ChoiceField(tr("Plant"), {}, 0));
  keep("tree.plant", plant_);
  treeRows_.push_back(plant_);
  connect(plant_, &ChoiceField::edited, this, [this](int index) {
    if (index < 0 || index >= static_cast<int>(plants_.size())) return;
    const model::AssetId plant = plants_[static_cast<std::size_t>(index)];
    editTrees([&](TreePlacement& tree) { tree.plant = plant; }, tr("Change the plant of trees"), {});
  });
  const NumberSpec place{.minimum = -30,
                         .maximum = 30,
                         .defaultValue = 0,
                         .decimals = 2,
                         .unit = "m",
                         .hardMinimum = -1000,
                         .hardMaximum = 1000};
  treeNumber(
      "tree.x", tr("East"), place, [](const TreePlacement& t) { return t.position.x(); },
      [](TreePlacement& t, double v) { t.position.setX(static_cast<float>(v)); });
  treeNumber(
      "tree.z", tr("South"), place, [](const TreePlacement& t) { return t.position.z(); },
      [](TreePlacement& t, double v) { t.position.setZ(static_cast<float>(v)); });
  treeNumber(
      "tree.y", tr("Up"),
      {.minimum = -5, .maximum = 5, .decimals = 2, .unit = "m", .hardMinimum = -100, .hardMaximum = 100},
      [](const TreePlacement& t) { return t.position.y(); },
      [](TreePlacement& t, double v) { t.position.setY(static_cast<float>(v)); });
  auto* heading = trees_->add(new DialField(tr("Heading"), 0, false));
  keep("tree.heading", heading);
  treeRows_.push_back(heading);
  connect(heading, &DialField::edited, this, [this, heading](double degrees) {
    editTrees([&](TreePlacement& tree) { tree.heading = degrees; }, tr("Turn trees"), heading->gesture());
  });
  treeShows_.push_back([heading](const std::vector<const TreePlacement*>& trees) {
    heading->setValue(trees.front()->heading);
    const auto differs = [&](const TreePlacement* t) { return t->heading != trees.front()->heading; };
    if (std::any_of(trees.begin(), trees.end(), differs)) heading->setMixed();
  });
  treeNumber(
      "tree.scale", tr("Scale"),
      {.minimum = 0.25, .maximum = 4, .defaultValue = 1, .logarithmic = true, .hardMinimum = 0.01, .hardMaximum = 100},
      [](const TreePlacement& t) { return t.scale; }, [](TreePlacement& t, double v) { t.scale = v; });
  QPushButton* duplicate = trees_->addButton(tr("Duplicate"), "duplicate");
  QPushButton* remove = trees_->addButton(tr("Delete"), "delete");
  treeRows_.push_back(duplicate);
  treeRows_.push_back(remove);
  addTree_ = trees_->addButton(tr("Add a tree"), "add");
  addTree_->setObjectName("tree.add");
  connect(duplicate, &QPushButton::clicked, this, &SceneInspector::duplicateWanted);
  connect(remove, &QPushButton::clicked, this, &SceneInspector::deleteWanted);
  connect(addTree_, &QPushButton::clicked, this, &SceneInspector::addTreeWanted);
}

void SceneInspector::showTrees() {
  const std::vector<const TreePlacement*> trees = chosen();
  noTree_->setVisible(trees.empty());
  for (QWidget* row : treeRows_) row->setVisible(!trees.empty());
  addTree_->setVisible(trees.empty());
  addTree_->setEnabled(!document_.project().plants.empty());
  if (trees.empty()) return;
  plants_.clear();
  QStringList names;
  for (const model::Plant& plant : document_.project().plants) {
    plants_.push_back(plant.id);
    names << plant.name;
  }
  {
    const QSignalBlocker blocker(plant_->box());
    plant_->box()->clear();
    plant_->box()->addItems(names);
  }
  const auto found = std::find(plants_.begin(), plants_.end(), trees.front()->plant);
  plant_->setValue(static_cast<int>(found - plants_.begin()));
  const auto differs = [&](const TreePlacement* t) { return t->plant != trees.front()->plant; };
  if (std::any_of(trees.begin(), trees.end(), differs)) plant_->setMixed();
  for (const auto& show : treeShows_) show(trees);
}

void SceneInspector::addDevice() {
  FieldGroup* group = addGroup("device", tr("Device"));
  deviceName_ = group->add(new InfoField(tr("Runs on")));
  keep("device.name", deviceName_);
  rendererName_ = group->add(new InfoField(tr("Drawn by")));
  keep("device.renderer", rendererName_);
  deviceProblem_ = new QLabel;
  deviceProblem_->setWordWrap(true);
  deviceProblem_->setProperty("hint", true);
  deviceProblem_->hide();
  group->addWidget(deviceProblem_);
}

void SceneInspector::showDevice() {
  const FrameResult& last = controller_.last();
  const QString name = QString::fromStdString(last.device.name);
  if (deviceName_->value() != name) deviceName_->setValue(name);
  const QString problem = QString::fromStdString(last.deviceProblem);
  if (deviceProblem_->text() != problem) {
    deviceProblem_->setText(problem);
    deviceProblem_->setVisible(!problem.isEmpty());
  }
}

void SceneInspector::setRendererName(const QString& name) { rendererName_->setValue(name); }

}  // namespace windfall::widgets
