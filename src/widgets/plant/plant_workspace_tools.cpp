// Tools and commands of the plant workspace: box, pull, pins, and what belongs together.
#include <QActionGroup>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>

#include "sim/self_buckling.h"
#include "widgets/look/icon.h"
#include "widgets/look/tool_action.h"
#include "widgets/plant/branch_attributes.h"
#include "widgets/plant/clip_panel.h"
#include "widgets/plant/link_choice.h"
#include "widgets/plant/plant_workspace.h"

namespace windfall::widgets {
namespace {
const QColor kPin(0xE8, 0x6A, 0x5C);
constexpr double kBuckles = 0.5;  // share of the buckling load above which a tree cannot be trusted to stand
}  // namespace

void PlantWorkspace::makeTools() {
  auto* group = new QActionGroup(this);
  const auto add = [&](ViewportTool& tool, const char* iconName, const QString& text, const QString& help,
                       const QKeySequence& shortcut) {
    QAction* action = toolAction(this, iconName, text, help, shortcut);
    group->addAction(action);
    connect(action, &QAction::toggled, this, [this, &tool, help](bool on) {
      if (!on) return;
      viewport_->setTool(&tool);
      emit status(help);
    });
    return action;
  };
  select_ = add(click_, "select", tr("Choose"),
                tr("Click a branch to choose it; Shift adds, Ctrl toggles, Alt chooses one link. Drag to look around."),
                Qt::Key_W);
  box_ = add(boxTool_, "box-select", tr("Choose by Box"),
             tr("Drag a rectangle over what is to be chosen; Shift adds. The middle button looks around."),
             QKeySequence("Shift+B"));
  pull_ = add(pullTool_, "pull", tr("Pull"), tr("Drag a branch: it follows the pointer, and sways when it is let go."),
              Qt::Key_H);
  select_->setChecked(true);
}

void PlantWorkspace::makeChoices() {
  const auto own = [this](QAction* action, const QKeySequence& shortcut) {
    action->setShortcut(shortcut);
    action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    viewport_->addAction(action);
    return action;
  };
  const auto choice = [&](const QString& text, const QKeySequence& shortcut, auto wanted) {
    auto* action = own(new QAction(text, this), shortcut);
    connect(action, &QAction::triggered, this, [this, wanted] { choose(wanted); });
    choices_.push_back(action);
    return action;
  };
  choice(tr("Choose Whole Branch"), QKeySequence("L"), [](const sim::Tree& tree, const Links& links) {
    return wholeBranches(tree, links);
  })->setObjectName("choose.branch");
  choice(tr("Choose Children"), QKeySequence("K"), [](const sim::Tree& tree, const Links& links) {
    return withChildren(tree, links);
  })->setObjectName("choose.children");
  choice(tr("Choose What Carries It"), QKeySequence("Shift+K"), [](const sim::Tree& tree, const Links& links) {
    return carriers(tree, links);
  })->setObjectName("choose.carriers");
  choice(tr("Choose the Same Order"), QKeySequence("O"), [](const sim::Tree& tree, const Links& links) {
    return sameOrder(tree, links);
  })->setObjectName("choose.order");
  choice(tr("Choose the Trunk"), QKeySequence("Shift+1"), [](const sim::Tree& tree, const Links&) {
    return ofOrder(tree, 0, 0);
  })->setObjectName("choose.trunk");
  choice(tr("Choose the Limbs"), QKeySequence("Shift+2"), [](const sim::Tree& tree, const Links&) {
    return ofOrder(tree, 1, 1);
  })->setObjectName("choose.limbs");
  choice(tr("Choose the Twigs"), QKeySequence("Shift+3"), [](const sim::Tree& tree, const Links&) {
    return ofOrder(tree, 2, 1000);
  })->setObjectName("choose.twigs");
  pin_ = own(new QAction(icon("pin"), tr("Pin or Let Go"), this), QKeySequence("Shift+P"));
  connect(pin_, &QAction::triggered, this, [this] { attributes_->togglePinned(); });
  copy_ = own(new QAction(tr("Copy Values of Branch"), this), QKeySequence::Copy);
  connect(copy_, &QAction::triggered, this, [this] { attributes_->copy(); });
  paste_ = own(new QAction(tr("Paste Values to Branches"), this), QKeySequence::Paste);
  connect(paste_, &QAction::triggered, this, [this] { attributes_->paste(); });
}

const sim::Tree* PlantWorkspace::tree() const {
  const model::SceneAssembly* assembly = feed_.assembly();
  return assembly == nullptr || assembly->sim.trees.empty() ? nullptr : assembly->sim.trees.front().tree.get();
}

void PlantWorkspace::choose(
    const std::function<std::vector<std::size_t>(const sim::Tree&, const std::vector<std::size_t>&)>& wanted) {
  if (tree() == nullptr) return;
  const Links links = wanted(*tree(), branches_->chosenLinks());
  if (!links.empty()) branches_->chooseLinks(links, false);
}

void PlantWorkspace::pull(const std::optional<sim::Pull>& pull) {
  controller_.setPull(pull);
  if (pull && !controller_.isPlaying()) controller_.play();
}

/// A pin stands at the base of every pinned stretch.
void PlantWorkspace::paintPins(QPainter& painter, const OrbitCamera& camera, QSize size) const {
  const model::Plant* plant = context_.document.project().plant(plant_);
  const model::LoadedPlant shown = loaded();
  if (plant == nullptr || !shown.geometry || !shown.bodies || tree() == nullptr) return;
  const std::vector<mat4>& pose = controller_.last().pose;
  const auto pinned = [&](std::size_t link) {
    const auto bone = static_cast<std::size_t>(shown.bodies->boneOfLink[link]);
    const auto edit = plant->edits.find(shown.geometry->bones[bone].name);
    return edit != plant->edits.end() && edit->second.pinned;
  };
  const std::size_t count = std::min({pose.size(), feed_.capsules().size(), shown.bodies->boneOfLink.size()});
  for (std::size_t i = 0; i < count; ++i) {
    const int parent = tree()->links[i].parent;
    if (!pinned(i) || (parent >= 0 && pinned(static_cast<std::size_t>(parent)))) continue;
    const auto at = camera.project(vec3(pose[i] * vec4(feed_.capsules()[i].from, 1)), size);
    if (!at) continue;
    QPainterPath pin;
    pin.moveTo(*at);
    pin.lineTo(*at + QPointF(-4.5, -11));
    pin.arcTo(QRectF(at->x() - 5.5, at->y() - 19, 11, 11), 200, -220);
    pin.closeSubpath();
    painter.setPen(QPen(QColor(0, 0, 0, 150), 1));
    painter.setBrush(kPin);
    painter.drawPath(pin);
    painter.setBrush(Qt::white);
    painter.setPen(Qt::NoPen);
    painter.drawEllipse(QPointF(at->x(), at->y() - 13.5), 2, 2);
  }
}

std::optional<Box> PlantWorkspace::bounds(bool chosenOnly) const {
  const std::vector<mat4> pose = feed_.restPose();
  if (!chosenOnly) return boundsOf(feed_.capsules(), pose);
  std::vector<LinkCapsule> capsules;
  for (const std::size_t link : chosen_) {
    if (link < feed_.capsules().size()) capsules.push_back(feed_.capsules()[link]);
  }
  return boundsOf(capsules, pose);
}

void PlantWorkspace::showClip() {
  const auto clip = clips_->chosen();
  const bool shown = clip != nullptr;
  controller_.setClip(shown ? ClipPanel::play(clip, loaded()) : nullptr);
  if (shown && !controller_.isPlaying()) controller_.play();
}

/// What an import had to mend, and whether the tree can carry itself: once for each plant.
void PlantWorkspace::tellAboutPlant() {
  const model::LoadedPlant shown = loaded();
  if (!shown.geometry || !shown.bodies || toldPlant_ == plant_) return;
  toldPlant_ = plant_;
  QStringList lines = shown.geometry->notes + shown.bodies->notes;
  const double own = sim::selfBuckling(shown.bodies->tree);
  if (own > kBuckles) {
    lines << tr("its own weight is %1 % of what makes it buckle: give it more radius or stiffer wood")
                 .arg(qRound(100 * own));
  }
  if (lines.isEmpty()) return;
  const model::Plant* plant = context_.document.project().plant(plant_);
  emit message(tr("%1: %2").arg(plant ? plant->name : QString(), lines.join(QStringLiteral("; "))), false);
}

}  // namespace windfall::widgets
