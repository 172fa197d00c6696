#include "widgets/plant/plant_workspace.h"

#include <QActionGroup>
#include <QHBoxLayout>
#include <QMenu>
#include <QPointer>
#include <QSplitter>
#include <algorithm>

#include "model/plant/grow/plant_presets.h"
#include "widgets/look/icon.h"
#include "widgets/look/look.h"
#include "widgets/plant/branch_attributes.h"
#include "widgets/plant/clip_panel.h"
#include "widgets/plant/link_choice.h"
#include "widgets/plant/motion_plot.h"
#include "widgets/plant/plant_settings.h"
#include "widgets/plant/plant_shaping.h"
#include "widgets/plant/surface_panel.h"
#include "widgets/scene/transport.h"
#include "widgets/viewport/camera_json.h"

namespace windfall::widgets {
namespace {

constexpr int kRegrowPause = 90;  // ms between the last change of a slider and the plant
constexpr float kCalmSeason = 0;  // leaves stay on while branches are tuned

}  // namespace

void PlantWorkspace::ClickTool::click(const ViewportEvent& event) {
  const Ray ray = event.camera.ray(event.position, event.size);
  workspace_.controller_.requestPose(
      [this, ray, slack = pickSlack(event), modifiers = event.modifiers](const std::vector<mat4>& pose) {
        if (const auto hit = pick(ray, workspace_.feed_.capsules(), pose, slack)) {
          if (modifiers & Qt::AltModifier) {
            workspace_.branches_->clickSingle(hit->link, modifiers);
          } else {
            workspace_.branches_->clickLink(hit->link, modifiers);
          }
        } else if (!(modifiers & (Qt::ShiftModifier | Qt::ControlModifier))) {
          workspace_.branches_->clear();
        }
      });
}

PlantWorkspace::PlantWorkspace(const WorkspaceContext& context, QObject* parent)
    : Workspace(parent),
      context_(context),
      feed_(context, controller_, "plant", [this] { return alone(); }),
      boxTool_(
          *this,
          [this](const QRectF& box, const ViewportEvent& event) {
            const Links links = insideBox(box, feed_.capsules(), controller_.last().pose, event.camera, event.size);
            branches_->chooseLinks(links, event.modifiers & (Qt::ShiftModifier | Qt::ControlModifier));
          },
          [this](const ViewportEvent& event) { click_.click(event); }),
      viewport_(new Viewport),
      inspector_(new QWidget),
      strip_(new QWidget) {
  viewport_->setObjectName("plantViewport");
  viewport_->setSource(&controller_);
  viewport_->setTool(&click_);
  viewport_->setBounds([this] { return bounds(true); }, [this] { return bounds(false); });
  makeTools();
  chooseAll_ = new QAction(tr("Choose All Branches"), this);
  chooseAll_->setShortcut(Qt::Key_A);
  chooseAll_->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  chooseNone_ = new QAction(tr("Choose None"), this);
  chooseNone_->setShortcut(QKeySequence("Alt+A"));
  chooseNone_->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  viewport_->addActions({chooseAll_, chooseNone_});
  makeInspector();
  makeStrip();
  // One tool at a time, those that shape the plant among them.
  for (QAction* tool : {box_, pull_}) select_->actionGroup()->addAction(tool);
  makeChoices();
  regrow_.setSingleShot(true);
  regrow_.setInterval(kRegrowPause);
  connect(&regrow_, &QTimer::timeout, this, [this] { feed_.rebuild(false); });

  connect(chooseAll_, &QAction::triggered, branches_, &BranchPanel::chooseAll);
  connect(chooseNone_, &QAction::triggered, branches_, &BranchPanel::clear);
  connect(&controller_, &SimulationController::redrawWanted, viewport_.data(), qOverload<>(&QWidget::update));
  connect(&controller_, &SimulationController::reported, this, &PlantWorkspace::showFrame);
  connect(&controller_, &SimulationController::problem, this,
          [this](const QString& text) { emit message(text, true); });
  connect(&feed_, &SceneFeed::assembled, this, &PlantWorkspace::showPlant);
  connect(&context_.document, &model::Document::changed, this, &PlantWorkspace::follow);
  controller_.setPoseWatched(true);
  follow({});
}

PlantWorkspace::~PlantWorkspace() {
  if (viewport_) {
    viewport_->setTool(nullptr);
    viewport_->setSource(nullptr);
  }
}

void PlantWorkspace::makeInspector() {
  auto* panel = new FieldPanel("plant");
  branches_ = new BranchPanel;
  attributes_ = new BranchAttributes(context_.document, *panel, this);
  settings_ = new PlantSettings(context_.document, *panel, this);
  surface_ = new SurfacePanel(context_.document, *panel, this);
  auto* splitter = new QSplitter(Qt::Vertical);
  splitter->setChildrenCollapsible(false);
  splitter->addWidget(branches_);
  splitter->addWidget(panel);
  splitter->setStretchFactor(0, 2);
  splitter->setStretchFactor(1, 3);
  auto* column = new QVBoxLayout(inspector_);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(splitter);
  clips_ = new ClipPanel(
      context_.document, context_.jobs, *panel,
      [this] {
        const auto project = alone();
        return project ? project->scene.wind : sim::WindSettings();
      },
      this);
  connect(clips_, &ClipPanel::chosenChanged, this, &PlantWorkspace::showClip);
  connect(clips_, &ClipPanel::message, this, &PlantWorkspace::message);
  connect(branches_, &BranchPanel::chosenChanged, this, &PlantWorkspace::showChosen);
  connect(settings_, &PlantSettings::plantChosen, this, &PlantWorkspace::choosePlant);
  connect(settings_, &PlantSettings::windChanged, this, &PlantWorkspace::setWind);
  connect(settings_, &PlantSettings::importWanted, this, &PlantWorkspace::askForFile);
  connect(settings_, &PlantSettings::growWanted, this, &PlantWorkspace::grow);
  connect(settings_, &PlantSettings::problem, this, [this](const QString& text) { emit message(text, true); });
  connect(surface_, &SurfacePanel::dataChosen, this, &PlantWorkspace::showData);
  connect(surface_, &SurfacePanel::replaceWanted, this, &PlantWorkspace::askForReplacement);
  connect(surface_, &SurfacePanel::reloadWanted, this, [this] {
    if (const auto path = paths_.find(plant_); path != paths_.end()) replaceFile(path->second);
  });
  connect(&watcher_, &QFileSystemWatcher::fileChanged, this, &PlantWorkspace::fileChanged);
  shaping_ = new PlantShaping({context_.document, *viewport_, feed_, controller_, [this] { return plant_; },
                               [this] { return loaded(); }, [this] { return branches_->chosenLinks(); }},
                              select_, click_, *panel, this);
  connect(shaping_, &PlantShaping::message, this, &Workspace::message);
  connect(shaping_, &PlantShaping::status, this, &Workspace::status);
}

void PlantWorkspace::makeStrip() {
  transport_ = new Transport(controller_, strip_);
  motion_ = new MotionPlot(strip_);
  auto* row = new QHBoxLayout(strip_);
  row->setContentsMargins(3 * kGrid, 2 * kGrid, 2 * kGrid, 2 * kGrid);
  row->setSpacing(4 * kGrid);
  row->addWidget(transport_);
  row->addWidget(motion_, 1);
}

QList<QAction*> PlantWorkspace::tools() { return QList<QAction*>{select_, box_, pull_} + shaping_->actions(); }

void PlantWorkspace::add() {
  auto* menu = new QMenu(viewport_);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->addAction(icon("import"), tr("Import Plant…"), this, &PlantWorkspace::askForFile);
  menu->addSeparator();
  fillNewMenu(*menu);
  menu->popup(QCursor::pos());
}

void PlantWorkspace::fillNewMenu(QMenu& menu) {
  for (const model::Preset& preset : model::plantPresets(model::PresetLibrary())) {
    menu.addAction(icon("plant"), preset.name, this, [this, name = preset.name] { growPreset(name); });
  }
}

void PlantWorkspace::growPreset(const QString& name) {
  Result<model::Plant> plant =
      model::plantOfPreset(model::PresetLibrary(), name, context_.document.project().plants.size() + 1);
  if (plant) {
    addPlant(std::move(*plant), {}, false);
  } else {
    emit message(QString::fromStdString(plant.error().message), true);
  }
}

void PlantWorkspace::fillMenu(QMenu& menu) {
  menu.addAction(icon("import"), tr("Import Plant…"), this, &PlantWorkspace::askForFile);
  menu.addAction(icon("plant"), tr("Grow Plant"), this, &PlantWorkspace::grow);
  menu.addAction(icon("export"), tr("Export Plant…"), this, [this] { exportResult(true); });
  QMenu* fresh = menu.addMenu(icon("plant"), tr("New Plant"));
  fresh->setObjectName("plant.new");
  fillNewMenu(*fresh);
  menu.addSeparator();
  menu.addActions(tools());
  menu.addSeparator();
  menu.addAction(transport_->playAction());
  menu.addAction(transport_->stepAction());
  menu.addAction(transport_->resetAction());
  menu.addSeparator();
  menu.addActions({select_, box_, pull_});
  menu.addSeparator();
  menu.addActions({pin_, copy_, paste_});
  menu.addSeparator();
  menu.addActions(QList<QAction*>(choices_.begin(), choices_.end()));
  menu.addAction(chooseAll_);
  menu.addAction(chooseNone_);
}

/// The shown plant at the origin, in a wind of this workspace.
std::optional<model::Project> PlantWorkspace::alone() const {
  const model::Project& project = context_.document.project();
  const model::Plant* plant = project.plant(plant_);
  if (plant == nullptr) return std::nullopt;
  model::Project alone;
  alone.plants = {*plant};
  for (const model::Leaf& leaf : project.leaves) {
    if (std::find(plant->leaves.begin(), plant->leaves.end(), leaf.id) != plant->leaves.end())
      alone.leaves.push_back(leaf);
  }
  model::TreePlacement tree;
  tree.id = {plant_.value + 1};
  tree.plant = plant_;
  tree.name = plant->name;
  alone.scene.trees = {tree};
  alone.scene.wind = project.scene.wind;
  alone.scene.wind.speed = static_cast<float>(settings_->wind());
  alone.scene.wind.until = sim::WindSettings().until;
  alone.scene.wind.course = sim::WindCourse::Steady;
  alone.scene.wind.fans.clear();
  alone.scene.leaves = project.scene.leaves;
  alone.scene.leaves.season = kCalmSeason;
  alone.scene.leaves.spawnHeight = 0;
  // A grower's plant is shown in full leaf, whatever the scene can afford.
  if (plant->file.isEmpty() && plant->grower && plant->grower->method != model::GrowMethod::Rule)
    alone.scene.leaves.count = model::kEveryLeaf;
  alone.scene.solver = project.scene.solver;
  alone.scene.light = project.scene.light;
  alone.scene.seed = project.scene.seed;
  return alone;
}

model::LoadedPlant PlantWorkspace::loaded() const {
  if (feed_.assembly() == nullptr) return {};
  const auto found = feed_.assembly()->plants.find(plant_);
  return found == feed_.assembly()->plants.end() ? model::LoadedPlant{} : found->second;
}

void PlantWorkspace::follow(const model::Change& change) {
  const model::Project& project = context_.document.project();
  if (change.aspect == model::Aspect::Everything) {
    controller_.pause();
    plant_ = framedPlant_ = {};
  }
  if (!project.plant(plant_)) {
    choosePlant(project.plants.empty() ? model::AssetId{} : project.plants.front().id);
    return;
  }
  switch (change.aspect) {
    case model::Aspect::PlantSource:
    case model::Aspect::PlantLeaves:
    case model::Aspect::PlantEdits:
      if (change.asset != plant_) return;
      [[fallthrough]];
    case model::Aspect::LeafVariants:
    case model::Aspect::Wind:
    case model::Aspect::FallingLeaves:
    case model::Aspect::Solver:
    case model::Aspect::Light:
      if (change.aspect == model::Aspect::PlantEdits) {
        feed_.follow(change);
        showChosen();
      } else if (active_ && change.aspect == model::Aspect::PlantSource) {
        regrow_.start();
      } else if (active_) {
        feed_.follow(change);
      } else {
        outdated_ = true;
      }
      showSettings();
      shaping_->show();
      break;
    case model::Aspect::PlantClips:
      clips_->show(plant_, loaded());
      break;
    case model::Aspect::Assets:
      showSettings();
      shaping_->show();
      break;
    default:
      break;
  }
}

void PlantWorkspace::choosePlant(model::AssetId plant) {
  plant_ = plant;
  branches_->setPlant({});
  outdated_ = true;
  if (active_ || !plant_) {
    outdated_ = false;
    feed_.rebuild(false);
  }
  showSettings();
  shaping_->show();
  viewport_->setHint(plant_ ? QString() : tr("Import a plant (FBX, glTF, .prim) or grow one."));
}

void PlantWorkspace::activate() {
  active_ = true;
  if (outdated_ && plant_) feed_.rebuild(false);
  outdated_ = false;
  viewport_->setFocus();
}

void PlantWorkspace::deactivate() {
  active_ = false;
  if (regrow_.isActive()) regrow_.stop(), outdated_ = true;
  pullTool_.cancel();
  boxTool_.cancel();
  controller_.pause();
}

void PlantWorkspace::show(model::AssetId asset) {
  if (context_.document.project().plant(asset) && asset != plant_) choosePlant(asset);
}

void PlantWorkspace::showPlant() {
  const model::LoadedPlant plant = loaded();
  branches_->setPlant(plant);
  showSettings();
  showData();
  shaping_->show();
  clips_->show(plant_, plant);
  showClip();
  tellAboutPlant();
  showChosen();
  if (framedPlant_ == plant_) return;
  framedPlant_ = plant_;
  const auto box = bounds(false);
  if (!box || std::exchange(keepCamera_, false)) return;
  viewport_->frameAtOnce(*box);
}

void PlantWorkspace::showSettings() {
  settings_->show(plant_, loaded());
  surface_->show(plant_);
  surface_->setChangedOnDisk(changedOnDisk_.contains(plant_));
}

void PlantWorkspace::showData() {
  const model::LoadedPlant plant = loaded();
  const model::PlantData what = surface_->data();
  if (what == model::PlantData::None || !plant.geometry || feed_.assembly()->sim.trees.empty()) {
    surface_->showData({});
    controller_.setLinkColors({});
    return;
  }
  const model::LinkData data = model::linkData(what, *plant.geometry, *plant.bodies,
                                               *feed_.assembly()->sim.trees.front().tree, controller_.last().pose);
  std::vector<std::uint32_t> colors;
  for (const float value : data.values) colors.push_back(model::dataColor(what, data, value));
  controller_.setLinkColors(std::move(colors));
  surface_->showData(data);
}

void PlantWorkspace::showChosen() {
  const model::SceneAssembly* assembly = feed_.assembly();
  const model::Plant* plant = context_.document.project().plant(plant_);
  if (assembly == nullptr || assembly->sim.trees.empty() || plant == nullptr) {
    attributes_->show({}, {}, nullptr, {}, 0);
    return;
  }
  std::set<QString> edited;
  for (const auto& [bone, attributes] : plant->edits) edited.insert(bone);
  branches_->model().setEdited(edited);
  const std::vector<std::size_t> links = branches_->chosenLinks();
  const std::vector<int> branches = branches_->chosenBranches();
  const auto tree = assembly->sim.trees.front().tree;
  attributes_->show(plant_, loaded(), tree, links, branches.size());
  if (links == chosen_ && tipLink_.has_value() == !links.empty()) return;
  chosen_ = links;
  controller_.setHighlighted({links.begin(), links.end()});
  tipLink_.reset();
  if (!links.empty()) tipLink_ = links.back();
  QString name;
  if (!branches.empty()) {
    const auto& all = loaded().bodies->branches;
    const int branch = tree->links[links.back()].chain;
    name = all[static_cast<std::size_t>(branch)].name;
  }
  motion_->start(name);
}

void PlantWorkspace::showFrame() {
  if (surface_->data() == model::PlantData::Stress) showData();
  const FrameResult& last = controller_.last();
  if (!tipLink_ || *tipLink_ >= last.pose.size() || *tipLink_ >= feed_.capsules().size()) return;
  const vec3 tip = feed_.capsules()[*tipLink_].to;
  motion_->add(last.statistics.time, vec3(last.pose[*tipLink_] * vec4(tip, 1)) - tip);
}

void PlantWorkspace::setWind(double) {
  if (const std::optional<model::Project> project = alone()) controller_.setWind(project->scene.wind);
}

void PlantWorkspace::grow() {
  model::Plant plant;
  plant.name = tr("Grown tree");
  plant.grower = model::GrowerSettings{};
  addPlant(std::move(plant));
}

/// The first plant of a project also gets a tree in the scene, so that there is something to see.
void PlantWorkspace::addPlant(model::Plant plant, const QString& path, bool withLeaves) {
  model::Document& document = context_.document;
  for (const model::Leaf& leaf : document.project().leaves) {
    if (withLeaves) plant.leaves.push_back(leaf.id);
  }
  document.undoStack().beginMacro(tr("Add %1").arg(plant.name));
  const model::AssetId id = document.addPlant(std::move(plant));
  if (document.project().scene.trees.empty()) {
    model::TreePlacement tree;
    tree.plant = id;
    tree.name = document.project().plant(id)->name;
    document.addTree(tree);
  }
  document.undoStack().endMacro();
  if (!path.isEmpty()) watchFile(id, path);
  choosePlant(id);
}

QJsonObject PlantWorkspace::saveView() const {
  return {{"camera", toJson(viewport_->camera().state())},
          {"wind", settings_->wind()},
          {"plant", double(plant_.value)},
          {"data", static_cast<int>(surface_->data())}};
}

void PlantWorkspace::restoreView(const QJsonObject& view) {
  if (const auto camera = cameraFromJson(view["camera"].toObject())) {
    viewport_->setCamera(*camera);
    keepCamera_ = true;
  }
  settings_->setWind(std::clamp(view["wind"].toDouble(settings_->wind()), 0.0, 60.0));
  show({static_cast<quint64>(view["plant"].toDouble())});
  setWind(settings_->wind());
  surface_->setData(static_cast<model::PlantData>(std::clamp(view["data"].toInt(0), 0, 7)));
}

bool PlantWorkspace::isSettled() const {
  return !regrow_.isActive() && !feed_.isAssembling() && controller_.isSettled() && !viewport_->isMoving();
}

}  // namespace windfall::widgets
