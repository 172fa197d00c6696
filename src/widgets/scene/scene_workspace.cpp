#include "widgets/scene/scene_workspace.h"

#include <QActionGroup>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLocale>
#include <QMenu>
#include <cmath>

#include "model/scene/wind_csv.h"
#include "widgets/look/icon.h"
#include "widgets/look/look.h"
#include "widgets/look/tool_action.h"
#include "widgets/scene/device_button.h"
#include "widgets/scene/history_plot.h"
#include "widgets/scene/leaf_counts.h"
#include "widgets/scene/scene_inspector.h"
#include "widgets/scene/transport.h"

namespace windfall::widgets {

SceneWorkspace::SceneWorkspace(const WorkspaceContext& context, QObject* parent)
    : Workspace(parent),
      context_(context),
      feed_(context, controller_, "scene",
            [this] { return std::optional<model::Project>(context_.document.project()); }),
      viewport_(new Viewport),
      inspector_(new SceneInspector(context.document, selection_, controller_)),
      strip_(new QWidget),
      device_(new DeviceButton(controller_)) {
  viewport_->setObjectName("sceneViewport");
  viewport_->setSource(&controller_);
  viewport_->setBounds([this] { return boundsOfTrees(true); }, [this] { return boundsOfTrees(false); });
  viewport_->setCamera(context.document.project().view.camera);
  makeTools();
  makeStrip();

  connect(&controller_, &SimulationController::redrawWanted, viewport_.data(), qOverload<>(&QWidget::update));
  connect(&controller_, &SimulationController::reported, this, &SceneWorkspace::showFrame);
  connect(&controller_, &SimulationController::problem, this,
          [this](const QString& text) { emit message(text, true); });
  connect(&controller_, &SimulationController::stopped, this, [this](double time, const QByteArray& bytes) {
    if (!feed_.isAssembling()) context_.document.setSimulation({time, bytes});
  });
  connect(&selection_, &SceneSelection::changed, this, [this] {
    controller_.setHighlighted(feed_.linksOf(selection_.trees()));
    duplicate_->setEnabled(!selection_.trees().empty());
    delete_->setEnabled(selection_.fan() >= 0 || !selection_.trees().empty());
    viewport_->update();
  });
  connect(&feed_, &SceneFeed::assembled, this, [this] {
    controller_.setHighlighted(feed_.linksOf(selection_.trees()));
    showHint();
    frameAll();
  });
  connect(viewport_.data(), &Viewport::cameraChanged, this, &SceneWorkspace::keepCamera);
  connect(viewport_.data(), &Viewport::drawn, this, [this] { inspector_->setRendererName(viewport_->rendererName()); });
  connect(inspector_, &SceneInspector::addTreeWanted, this, &SceneWorkspace::addTree);
  connect(inspector_, &SceneInspector::duplicateWanted, this, &SceneWorkspace::duplicateTrees);
  connect(inspector_, &SceneInspector::deleteWanted, this, &SceneWorkspace::deleteTrees);
  connect(inspector_, &SceneInspector::fanWanted, this, [this] {
    const Ray ray =
        viewport_->camera().ray(QPointF(viewport_->width() * 0.3, viewport_->height() * 0.75), viewport_->size());
    fan_.placeFan(meetGround(ray, 0).value_or(vec3(-3, 0, 0)));
    fanAction_->setChecked(true);
  });
  connect(inspector_, &SceneInspector::fanDeleteWanted, this, [this] { fan_.removeChosen(); });
  connect(inspector_, &SceneInspector::recordWanted, this, &SceneWorkspace::askForRecord);
  connect(inspector_, &SceneInspector::streaksWanted, this, &SceneWorkspace::setStreaks);
  connect(&selection_, &SceneSelection::fanChanged, viewport_.data(), qOverload<>(&QWidget::update));
  connect(&context_.document, &model::Document::changed, this, &SceneWorkspace::follow);
  follow({});
}

SceneWorkspace::~SceneWorkspace() {
  if (viewport_) {
    viewport_->setTool(nullptr);
    viewport_->setSource(nullptr);
  }
}

QWidget* SceneWorkspace::canvas() { return viewport_; }
QWidget* SceneWorkspace::inspector() { return inspector_; }
QWidget* SceneWorkspace::strip() { return strip_; }

QAction* SceneWorkspace::addTool(ViewportTool& tool, const QString& iconName, const QString& text, const QString& help,
                                 const QKeySequence& shortcut) {
  QAction* action = toolAction(this, iconName, text, help, shortcut);
  connect(action, &QAction::toggled, this, [this, &tool, help](bool on) {
    if (!on) return;
    viewport_->setTool(&tool);
    emit status(help);
  });
  toolGroup_->addAction(action);
  return action;
}

void SceneWorkspace::makeTools() {
  toolGroup_ = new QActionGroup(this);
  addTool(select_, "select", tr("Choose"),
          tr("Click a tree to choose it; Shift adds, Ctrl toggles. Drag to look around."), Qt::Key_W)
      ->setChecked(true);
  addTool(move_, "move", tr("Move"), tr("Drag a tree over the ground."), Qt::Key_G);
  addTool(turn_, "loop", tr("Turn"), tr("Drag a tree to turn it; Shift snaps to 15 degrees."), Qt::Key_R);
  fanAction_ =
      addTool(fan_, "fan", tr("Fan"),
              tr("Click the ground to place a fan. Drag it over the ground (Shift: up and down), or the tip of its "
                 "arrow to turn it."),
              Qt::Key_F);
  streaks_ = new QAction(icon("wind"), tr("Show the Wind"), this);
  streaks_->setCheckable(true);
  streaks_->setShortcut(QKeySequence("Shift+W"));
  connect(streaks_, &QAction::toggled, this, &SceneWorkspace::setStreaks);
  duplicate_ = new QAction(icon("duplicate"), tr("Duplicate Trees"), this);
  duplicate_->setShortcut(QKeySequence("Shift+D"));
  delete_ = new QAction(icon("delete"), tr("Delete Trees"), this);
  selectAll_ = new QAction(tr("Choose All Trees"), this);
  selectAll_->setShortcut(Qt::Key_A);
  // Other places of the window use these keys for their own things.
  delete_->setShortcut(Qt::Key_Delete);
  for (QAction* action : {delete_, selectAll_, duplicate_}) {
    action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    viewport_->addAction(action);
  }
  duplicate_->setEnabled(false);
  delete_->setEnabled(false);
  connect(duplicate_, &QAction::triggered, this, &SceneWorkspace::duplicateTrees);
  connect(delete_, &QAction::triggered, this, [this] { selection_.fan() >= 0 ? fan_.removeChosen() : deleteTrees(); });
  connect(&selection_, &SceneSelection::fanChanged, this,
          [this] { delete_->setEnabled(selection_.fan() >= 0 || !selection_.trees().empty()); });
  connect(selectAll_, &QAction::triggered, this, [this] {
    std::vector<model::AssetId> all;
    for (const model::TreePlacement& tree : context_.document.project().scene.trees) all.push_back(tree.id);
    selection_.set(all);
  });
}

void SceneWorkspace::makeStrip() {
  transport_ = new Transport(controller_, strip_);
  counts_ = new LeafCounts(strip_);
  timers_ = new HistoryPlot({tr("Wind"), tr("Trees"), tr("Leaves"), tr("Output"), tr("Drawing")}, tr("ms"), strip_);
  timers_->setToolTip(tr("Time of the last frames, and each part's share"));
  auto* row = new QHBoxLayout(strip_);
  row->setContentsMargins(3 * kGrid, 2 * kGrid, 2 * kGrid, 2 * kGrid);
  row->setSpacing(4 * kGrid);
  row->addWidget(transport_);
  row->addWidget(counts_);
  row->addWidget(timers_, 1);
}

QList<QAction*> SceneWorkspace::tools() { return toolGroup_->actions(); }

void SceneWorkspace::fillMenu(QMenu& menu) {
  menu.addAction(transport_->playAction());
  menu.addAction(transport_->stepAction());
  menu.addAction(transport_->resetAction());
  menu.addSeparator();
  menu.addActions(toolGroup_->actions());
  menu.addAction(streaks_);
  menu.addAction(icon("open"), tr("Load Recorded Wind…"), this, &SceneWorkspace::askForRecord);
  menu.addSeparator();
  QAction* add = menu.addAction(icon("add"), tr("Add Tree"), this, &SceneWorkspace::addTree);
  add->setShortcut(QKeySequence("Shift+A"));
  menu.addAction(duplicate_);
  menu.addAction(delete_);
  menu.addAction(selectAll_);
}

void SceneWorkspace::activate() { viewport_->setFocus(); }

void SceneWorkspace::deactivate() {
  controller_.pause();
  select_.cancel();
  move_.cancel();
  turn_.cancel();
  fan_.cancel();
}

void SceneWorkspace::show(model::AssetId asset) {
  if (context_.document.project().tree(asset)) selection_.set({asset});
}

bool SceneWorkspace::isSettled() const {
  return !feed_.isAssembling() && controller_.isSettled() && !viewport_->isMoving();
}

/// While the scene is still being assembled, the document has the state that it will go on from.
void SceneWorkspace::beforeSave() {
  if (feed_.isAssembling()) return;
  if (const auto state = controller_.saveState()) context_.document.setSimulation({state->time, state->bytes});
}

model::AssetId SceneWorkspace::treeAt(const Ray& ray, float slack, vec3* place) {
  const auto hit = pick(ray, feed_.capsules(), feed_.restPose(), slack);
  if (!hit) return {};
  if (place != nullptr) *place = ray.origin + ray.direction * hit->distance;
  for (const TreeSpan& span : feed_.spans()) {
    if (hit->link >= span.firstLink && hit->link < span.firstLink + span.linkCount) return span.tree;
  }
  return {};
}

void SceneWorkspace::follow(const model::Change& change) {
  if (change.aspect == model::Aspect::Everything) {
    controller_.pause();
    framed_ = context_.document.project().view.camera != model::Camera();
    viewport_->setCamera(context_.document.project().view.camera);
  }
  std::vector<model::AssetId> alive;
  for (const model::AssetId id : selection_.trees()) {
    if (context_.document.project().tree(id)) alive.push_back(id);
  }
  selection_.set(alive);
  if (selection_.fan() >= static_cast<int>(context_.document.project().scene.wind.fans.size())) selection_.setFan(-1);
  feed_.follow(change);
  inspector_->follow(change);
  showHint();
}

bool SceneWorkspace::openFile(const QString& path) {
  if (QFileInfo(path).suffix().compare(QLatin1String("csv"), Qt::CaseInsensitive) != 0) return false;
  loadRecord(path);
  return true;
}

void SceneWorkspace::askForRecord() {
  const QString path =
      QFileDialog::getOpenFileName(viewport_, tr("Load Recorded Wind"), {}, tr("Tables (*.csv *.txt)"));
  if (!path.isEmpty()) loadRecord(path);
}

void SceneWorkspace::loadRecord(const QString& path) {
  sim::WindSettings wind = context_.document.project().scene.wind;
  if (const Status read = model::readWindFile(path, wind); !read) {
    emit message(QStringLiteral("%1: %2").arg(QFileInfo(path).fileName(), QString::fromStdString(read.error().message)),
                 true);
    return;
  }
  context_.document.setScene(&model::Scene::wind, wind, model::Aspect::Wind, tr("Load recorded wind"));
  emit message(
      tr("%1: %n rows of wind", nullptr, static_cast<int>(wind.records.size())).arg(QFileInfo(path).fileName()), false);
}

void SceneWorkspace::setStreaks(bool on) {
  controller_.setStreaks(on);
  streaks_->setChecked(on);
  inspector_->setStreaks(on);
}

QJsonObject SceneWorkspace::saveView() const { return {{"streaks", streaks_->isChecked()}}; }
void SceneWorkspace::restoreView(const QJsonObject& view) { setStreaks(view["streaks"].toBool()); }

void SceneWorkspace::showHint() {
  const model::Project& project = context_.document.project();
  viewport_->setHint(project.plants.empty()        ? tr("No plant yet. Import or grow one in the Plant workspace.")
                     : project.scene.trees.empty() ? tr("No tree yet. Shift+A plants one.")
                                                   : QString());
}

void SceneWorkspace::showFrame() {
  const FrameResult& last = controller_.last();
  counts_->show(last.statistics);
  if (!last.written) return;
  // A frame that did not move has no timers worth a line.
  if (last.advance.steps > 0 || !controller_.isPlaying()) {
    timers_->add(
        {last.timers.wind, last.timers.trees, last.timers.leaves, last.timers.output, viewport_->lastDrawTime()});
  }
}

void SceneWorkspace::keepCamera() {
  if (viewport_->isMoving() || keepingCamera_) return;
  model::ViewState view = context_.document.project().view;
  if (view.camera == viewport_->camera().state()) return;
  view.camera = viewport_->camera().state();
  keepingCamera_ = true;
  context_.document.setView(view);
  keepingCamera_ = false;
}

std::optional<Box> SceneWorkspace::boundsOfTrees(bool chosenOnly) const {
  const std::vector<mat4> pose = feed_.restPose();
  if (!chosenOnly) return boundsOf(feed_.capsules(), pose);
  std::vector<LinkCapsule> capsules;
  std::vector<mat4> matrices;
  for (const std::uint32_t link : feed_.linksOf(selection_.trees())) {
    capsules.push_back(feed_.capsules()[link]);
    matrices.push_back(pose[link]);
  }
  return boundsOf(capsules, matrices);
}

/// The first scene of a project that has no camera of its own is shown whole.
void SceneWorkspace::frameAll() {
  if (framed_) return;
  const auto box = boundsOfTrees(false);
  if (!box) return;
  framed_ = true;
  viewport_->frameAtOnce(*box);
}

void SceneWorkspace::addTree() {
  const model::Project& project = context_.document.project();
  if (project.plants.empty()) {
    emit message(tr("There is no plant to set yet: import or grow one in the Plant workspace."), false);
    return;
  }
  model::TreePlacement tree;
  tree.plant = project.plants.front().id;
  for (const model::TreePlacement& other : project.scene.trees) {
    if (selection_.contains(other.id)) tree.plant = other.plant;
  }
  tree.name = project.plant(tree.plant)->name;
  // Beside those that stand there: on a spiral, so that no two share a place.
  const auto count = static_cast<double>(project.scene.trees.size());
  const double angle = 2.39996 * count, reach = count > 0 ? 3.0 * std::sqrt(count) : 0;
  tree.position = {static_cast<float>(std::cos(angle) * reach), 0, static_cast<float>(std::sin(angle) * reach)};
  selection_.set({context_.document.addTree(tree)});
}

void SceneWorkspace::duplicateTrees() {
  const std::vector<model::AssetId> trees = selection_.trees();
  if (trees.empty()) return;
  model::Document& document = context_.document;
  std::vector<model::AssetId> copies;
  document.undoStack().beginMacro(tr("Duplicate trees"));
  for (const model::AssetId tree : trees) {
    const model::AssetId copy = document.duplicate(tree);
    if (!copy) continue;
    copies.push_back(copy);
    document.setTree(copy, &model::TreePlacement::position,
                     document.project().tree(copy)->position + QVector3D(2, 0, 1), tr("Move trees"));
  }
  document.undoStack().endMacro();
  selection_.set(copies);
}

void SceneWorkspace::deleteTrees() {
  const std::vector<model::AssetId> trees = selection_.trees();
  if (trees.empty()) return;
  context_.document.undoStack().beginMacro(tr("Delete trees"));
  for (const model::AssetId tree : trees) context_.document.remove(tree);
  context_.document.undoStack().endMacro();
}

}  // namespace windfall::widgets
