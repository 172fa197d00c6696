#include "widgets/leaf/leaf_workspace.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QLineF>
#include <QMenu>
#include <QPushButton>
#include <QSettings>
#include <QSplitter>
#include <QStackedWidget>
#include <QVBoxLayout>

#include "model/leaf/marker_image.h"
#include "model/leaf/mask_edit.h"
#include "widgets/fields/choice_field.h"
#include "widgets/leaf/atlas_panel.h"
#include "widgets/leaf/image_pane.h"
#include "widgets/leaf/leaf_inspector.h"
#include "widgets/leaf/leaf_jobs.h"
#include "widgets/leaf/leaf_pictures.h"
#include "widgets/leaf/leaf_tool_box.h"
#include "widgets/leaf/maps_view.h"
#include "widgets/leaf/region_match_view.h"
#include "widgets/leaf/stage_bar.h"
#include "widgets/leaf/tool_options.h"
#include "widgets/leaf/variant_scores.h"
#include "widgets/leaf/variant_strip.h"
#include "widgets/look/empty_state.h"
#include "widgets/look/icon.h"

namespace windfall::widgets {

using model::Aspect;
using model::AssetId;
using model::Leaf;
using model::Stage;

namespace {
const QString kPhotoFolder = QStringLiteral("photoFolder");
const QString kAtlasFile = QStringLiteral("atlasFile");
}  // namespace

LeafWorkspace::LeafWorkspace(WorkspaceContext context, QWidget* window)
    : Workspace(window),
      context_(context),
      pictures_(new LeafPictures(context.document, context.jobs, this)),
      jobs_(new LeafJobs(context.document, context.jobs, this)),
      maps_(new MapsView(context.document, context.jobs, this)),
      window_(window) {
  buildCanvas(window);
  inspector_ = new LeafInspector(context.document, window);
  strip_ = new VariantStrip(context.document, window);
  strip_->setScores(new VariantScores(context.document, context.jobs, strip_));
  toolBox_ = new LeafToolBox(context.document, context.jobs, *pictures_, *pane_, this);
  toolOptions_->setToolBox(toolBox_);

  connect(toolBox_, &LeafToolBox::stageNeeded, this, &LeafWorkspace::setStage);
  connect(toolBox_, &LeafToolBox::toolChanged, this, [this] {
    match_->setActive(toolBox_->current().id() == QLatin1String("link"));
    updateStatus();
  });
  connect(toolBox_, &LeafToolBox::regionChosen, match_, &RegionMatchView::choose);
  connect(match_, &RegionMatchView::pictureChanged, this, &LeafWorkspace::updatePicture);
  connect(stageBar_, &StageBar::fieldChanged, this, [this] { pictures_->setField(stageBar_->field()); });
  connect(stageBar_, &StageBar::chosen, this, &LeafWorkspace::setStage);
  connect(stageBar_, &StageBar::opacityChanged, this, [this] { updatePicture(); });
  connect(pictures_, &LeafPictures::photoChanged, this, [this] {
    pane_->setBase(pictures_->photo());
    inspector_->setPhotoSize(pictures_->photo().size());
    if (!pictures_->photo().isNull()) {
      // A brush that fits the picture, whatever its size.
      const QSize size = pictures_->photo().size();
      toolBox_->setToolSize(std::max(4.0, std::max(size.width(), size.height()) / 32.0));
    }
  });
  connect(pictures_, &LeafPictures::pictureChanged, this, &LeafWorkspace::updatePicture);
  connect(pictures_, &LeafPictures::maskPartChanged, this, [this](QRect part) {
    pane_->replaceOverlay(LeafPictures::maskTint(pictures_->mask(), part), part.topLeft());
  });
  connect(pictures_, &LeafPictures::statesChanged, this, &LeafWorkspace::updateStates);
  connect(pictures_, &LeafPictures::statesChanged, this, [this] {
    inspector_->showFound(pictures_->stages());
    tellOfMarkers();
  });
  connect(inspector_, &LeafInspector::loadVeinsRequested, this, &LeafWorkspace::loadVeins);
  connect(pane_, &ImagePane::pointed, this, [this](QPointF at) {
    pointer_ = at;
    updateStatus();
  });
  connect(pane_, &ImagePane::viewChanged, this, &LeafWorkspace::updateStatus);
  connect(inspector_, &LeafInspector::replacePhotoRequested, this, [this] {
    const QString path = askForPhoto(tr("Replace Photo"));
    if (!path.isEmpty()) jobs_->openPhoto(path, leaf());
  });
  connect(inspector_, &LeafInspector::mapChosen, this, [this] {
    if (stage_ == Stage::Maps) return updatePicture();
    if (!pictures_->leaf() || pictures_->leaf()->variants.empty()) return;
    setStage(Stage::Maps);
  });
  connect(inspector_, &LeafInspector::message, this, &Workspace::message);
  connect(maps_, &MapsView::changed, this, [this] {
    if (variantsShown_) pane_->setOverlay(maps_->picture());
  });
  connect(strip_, &VariantStrip::makeRequested, this, &LeafWorkspace::makeVariants);
  connect(strip_, &VariantStrip::opened, this, [this] { setStage(Stage::Variants); });
  connect(strip_, &VariantStrip::chosen, this, [this] {
    if (variantsShown_) updatePicture();
  });
  connect(jobs_, &LeafJobs::variantsChanged, strip_, &VariantStrip::setBusy);
  connect(jobs_, &LeafJobs::message, this, &Workspace::message);
  connect(jobs_, &LeafJobs::photoOpened, this, [this](AssetId id) {
    show(id);
    setStage(Stage::Mask);
    jobs_->offerSplit(id);
  });
  connect(&context_.document, &model::Document::changed, this, [this](const model::Change& change) {
    const std::vector<Leaf>& leaves = context_.document.project().leaves;
    if (change.aspect == Aspect::Everything || !context_.document.project().leaf(leaf())) {
      show(leaves.empty() ? AssetId() : leaves.front().id);
    } else if (change.asset == leaf() && variantsShown_ &&
               (change.aspect == Aspect::LeafVariants || change.aspect == Aspect::LeafParameters)) {
      updatePicture();
    }
  });
  const std::vector<Leaf>& leaves = context_.document.project().leaves;
  if (!leaves.empty()) LeafWorkspace::show(leaves.front().id);
  updateStates();
}

LeafWorkspace::~LeafWorkspace() = default;

void LeafWorkspace::buildCanvas(QWidget* window) {
  canvas_ = new QWidget(window);
  auto* column = new QVBoxLayout(canvas_);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  stageBar_ = new StageBar(canvas_);
  stack_ = new QStackedWidget(canvas_);
  auto* empty = new EmptyState(QStringLiteral("leaf"), tr("A leaf to begin with"),
                               tr("Drop a photo of a leaf here. Windfall finds its outline and veins, and makes as "
                                  "many new textures of it as you want."),
                               stack_);
  connect(empty->addButton(tr("Open a leaf photo…"), {}, true), &QPushButton::clicked, this, &LeafWorkspace::add);
  pane_ = new ImagePane(stack_);
  match_ = new RegionMatchView(context_.document, context_.jobs, *pictures_, stack_);
  auto* sideBySide = new QSplitter(Qt::Horizontal, stack_);
  sideBySide->setChildrenCollapsible(false);
  sideBySide->addWidget(pane_);
  sideBySide->addWidget(match_);
  sideBySide->setStretchFactor(0, 3);
  sideBySide->setStretchFactor(1, 2);
  match_->hide();
  atlas_ = new AtlasPanel(context_.document, context_.jobs, stack_);
  connect(atlas_, &AtlasPanel::exportRequested, this, &LeafWorkspace::exportResult);
  stack_->addWidget(empty);
  stack_->addWidget(sideBySide);
  stack_->addWidget(atlas_);
  column->addWidget(stageBar_);
  toolOptions_ = new ToolOptions(canvas_);
  column->addWidget(toolOptions_);
  column->addWidget(stack_, 1);
  canvas_->setFocusProxy(pane_);
}

QWidget* LeafWorkspace::inspector() { return inspector_; }
QWidget* LeafWorkspace::strip() { return strip_; }
QList<QAction*> LeafWorkspace::tools() { return toolBox_->actions(); }
AssetId LeafWorkspace::leaf() const { return pictures_->leafId(); }

template <class T>
void LeafWorkspace::resetMark(T Leaf::*mark, Aspect aspect, const QString& text) {
  context_.document.setLeaf(leaf(), mark, T(), aspect, text);
}

void LeafWorkspace::fillMenu(QMenu& menu) {
  const auto add = [&](const QString& text, const QString& iconName, const QString& keys, auto slot) {
    QAction* action = menu.addAction(icon(iconName), text);
    action->setShortcut(QKeySequence(keys));
    connect(action, &QAction::triggered, this, slot);
  };
  add(tr("Open Leaf &Photo…"), QStringLiteral("photo"), QStringLiteral("Ctrl+Shift+O"), [this] { this->add(); });
  menu.addSeparator();
  menu.addActions(toolBox_->actions());
  add(tr("Larger Brush"), {}, QStringLiteral("]"), [this] { toolBox_->resizeTool(1); });
  add(tr("Smaller Brush"), {}, QStringLiteral("["), [this] { toolBox_->resizeTool(-1); });
  menu.addSeparator();
  add(tr("Zoom to 100 %"), QStringLiteral("search"), QStringLiteral("1"), [this] { pane_->setZoom(1); });
  add(tr("Fit the Picture"), QStringLiteral("frame"), QStringLiteral("2"), [this] { pane_->fit(); });
  add(tr("Fit the Width"), {}, QStringLiteral("3"), [this] { pane_->fitWidth(); });
  menu.addSeparator();
  addMaskActions(menu);
  addVeinActions(menu);
  menu.addSeparator();
  add(tr("Automatic Mask"), QStringLiteral("mask"), {},
      [this] { resetMark(&Leaf::mask, Aspect::LeafMask, tr("Automatic mask")); });
  add(tr("Automatic Root"), QStringLiteral("root"), {},
      [this] { resetMark(&Leaf::root, Aspect::LeafRoot, tr("Automatic root")); });
  add(tr("Automatic Tips"), QStringLiteral("tip"), {},
      [this] { resetMark(&Leaf::tips, Aspect::LeafRoot, tr("Automatic tips")); });
  add(tr("Automatic Regions"), QStringLiteral("marker"), {},
      [this] { resetMark(&Leaf::markers, Aspect::LeafMarkers, tr("Automatic regions")); });
  menu.addSeparator();
  add(tr("&Make Variants"), QStringLiteral("dice"), QStringLiteral("Ctrl+Return"),
      [this] { strip_->makeButton()->click(); });
  add(tr("Export &Atlas…"), QStringLiteral("atlas"), {}, [this] { exportResult(true); });
}

void LeafWorkspace::addMaskActions(QMenu& menu) {
  const auto add = [&](const QString& text, const QString& keys, std::function<QImage(const QImage&)> edit) {
    QAction* action = menu.addAction(text);
    action->setShortcut(QKeySequence(keys));
    connect(action, &QAction::triggered, this, [this, text, edit = std::move(edit)] {
      setStage(Stage::Mask);
      QString plain = text;
      toolBox_->editMask(plain.remove(QLatin1Char('&')), edit);
    });
  };
  // A step that is seen on a large photo and not too much on a small one.
  const auto step = [](const QImage& mask) { return std::max(1, std::max(mask.width(), mask.height()) / 600); };
  add(tr("&Grow Mask"), QStringLiteral("Ctrl+Alt+]"),
      [step](const QImage& mask) { return model::grownMask(mask, step(mask)); });
  add(tr("Shrin&k Mask"), QStringLiteral("Ctrl+Alt+["),
      [step](const QImage& mask) { return model::grownMask(mask, -step(mask)); });
  add(tr("&Invert Mask"), QStringLiteral("Ctrl+Shift+I"), [](const QImage& mask) { return model::invertedMask(mask); });
  add(tr("&Fill Holes of the Mask"), {}, [](const QImage& mask) { return model::filledMask(mask); });
  QAction* split = menu.addAction(tr("&Separate Several Leaves"));
  split->setToolTip(tr("Makes a leaf asset of each leaf in the photo"));
  connect(split, &QAction::triggered, this, [this] { jobs_->splitLeaves(leaf(), pictures_->mask()); });
}

void LeafWorkspace::addVeinActions(QMenu& menu) {
  connect(menu.addAction(tr("&Load Vein Picture…")), &QAction::triggered, this, &LeafWorkspace::loadVeins);
  connect(menu.addAction(tr("Veins from the &Photo")), &QAction::triggered, this, [this] {
    const Leaf* shown = pictures_->leaf();
    if (!shown) return;
    setStage(Stage::Veins);
    model::LeafParameters parameters = shown->parameters;
    parameters.veins.fromPhoto = true;
    context_.document.undoStack().beginMacro(tr("Veins of the photo"));
    resetMark(&Leaf::veins, Aspect::LeafVeins, tr("Veins of the photo"));
    context_.document.setLeaf(leaf(), &Leaf::parameters, parameters, Aspect::LeafParameters, tr("Veins of the photo"));
    context_.document.undoStack().endMacro();
  });
  connect(menu.addAction(tr("Automatic &Veins")), &QAction::triggered, this,
          [this] { resetMark(&Leaf::veins, Aspect::LeafVeins, tr("Automatic veins")); });
}

void LeafWorkspace::loadVeins() {
  if (!pictures_->leaf()) return;
  const QString path = askForPhoto(tr("Load Vein Picture"));
  if (path.isEmpty()) return;
  setStage(Stage::Veins);
  jobs_->loadVeins(path, leaf());
}

void LeafWorkspace::deactivate() { toolBox_->cancel(); }

void LeafWorkspace::show(AssetId id) {
  const bool another = id != leaf();
  if (another) toolBox_->cancel();
  pictures_->setLeaf(id);
  inspector_->setLeaf(id);
  strip_->setLeaf(id);
  stack_->setCurrentIndex(!context_.document.project().leaf(id) ? 0 : stage_ == Stage::Atlas ? 2 : 1);
  stageBar_->setEnabled(bool(context_.document.project().leaf(id)));
  updateStates();
  updatePicture();
}

void LeafWorkspace::setStage(Stage stage) {
  stageBar_->setStage(stage);
  // Regions are matched on their own stage alone.
  if (match_->isActive() && stage != Stage::Regions) toolBox_->choose(QStringLiteral("hand"));
  if (stage != stage_) inspector_->showStage(stage);
  stage_ = stage;
  variantsShown_ = stage >= Stage::Variants;
  pictures_->want(std::min(stage, Stage::Variants));
  const bool any = bool(context_.document.project().leaf(leaf()));
  toolOptions_->setVisible(stage != Stage::Atlas);
  stack_->setCurrentIndex(!any ? 0 : stage == Stage::Atlas ? 2 : 1);
  updatePicture();
}

void LeafWorkspace::updateStates() {
  for (int i = int(Stage::Photo); i <= int(Stage::Atlas); ++i) {
    stageBar_->setState(Stage(i), pictures_->state(Stage(i)));
  }
  pane_->update();
}

void LeafWorkspace::tellOfMarkers() {
  const Leaf* shown = pictures_->leaf();
  if (!shown || !pictures_->isUpToDate(Stage::Regions) || toldOf_ == shown->markers) return;
  toldOf_ = shown->markers;
  const Status good = model::checkMarkers(*pictures_->stages());
  if (!good) emit message(QString::fromStdString(good.error().message), true);
}

void LeafWorkspace::updatePicture() {
  const Leaf* shown = pictures_->leaf();
  const bool alone = variantsShown_ && shown && !shown->variants.empty();
  pane_->setBaseVisible(!alone);
  if (alone) {
    pane_->setLegend({});
    const int chosen = std::clamp(strip_->current(), 0, int(shown->variants.size()) - 1);
    pane_->setOverlayOpacity(1);
    const auto kind = stage_ == Stage::Maps ? model::MapKind(inspector_->mapKind()->value()) : model::MapKind::Colour;
    maps_->show(shown->id, chosen, kind, pictures_->isUpToDate(Stage::Veins) ? pictures_->stages() : nullptr);
    pane_->setOverlay(maps_->picture());
    return;
  }
  pane_->setOverlayOpacity(stageBar_->opacity());
  const bool matching = match_->isActive() && !match_->targetPicture().isNull();
  pane_->setOverlay(variantsShown_ ? MipImage() : matching ? match_->targetPicture() : pictures_->picture());
  const model::LeafStages* known = pictures_->stages();
  const bool field =
      pictures_->wanted() == Stage::Distance && known && !variantsShown_ && !pictures_->scale().ramp.empty();
  const double blade = field ? QLineF(known->root, known->tip).length() * known->scale : 0;
  pane_->setLegend(field ? legendOf(pictures_->field(), pictures_->scale(), blade / std::max(1e-6, known->bladeLength))
                         : Legend());
}

void LeafWorkspace::updateStatus() {
  if (!pictures_->leaf()) return emit status({});
  const QString zoom = tr("%1 %").arg(qRound(100 * pane_->zoom()));
  const QString size =
      toolBox_->current().size() > 0 ? tr("brush %1 px · ").arg(qRound(toolBox_->current().size())) : QString();
  emit status(tr("%1%2, %3 px · %4").arg(size).arg(qRound(pointer_.x())).arg(qRound(pointer_.y())).arg(zoom));
}

void LeafWorkspace::makeVariants(int count) {
  const bool ready = pictures_->isUpToDate(Stage::Superpixels);
  jobs_->makeVariants(leaf(), count, ready ? pictures_->stages() : nullptr);
}

QString LeafWorkspace::askForPhoto(const QString& title) {
  QStringList patterns;
  for (const QString& ending : photoEndings()) patterns << QStringLiteral("*.") + ending;
  QString path = QFileDialog::getOpenFileName(window_, title, QSettings().value(kPhotoFolder).toString(),
                                              tr("Pictures (%1)").arg(patterns.join(QLatin1Char(' '))));
  if (!path.isEmpty()) QSettings().setValue(kPhotoFolder, QFileInfo(path).absolutePath());
  return path;
}

void LeafWorkspace::add() {
  const QString path = askForPhoto(tr("Open Leaf Photo"));
  if (!path.isEmpty()) jobs_->openPhoto(path);
}

bool LeafWorkspace::openFile(const QString& path) {
  if (!photoEndings().contains(QFileInfo(path).suffix().toLower())) return false;
  jobs_->openPhoto(path);
  return true;
}

void LeafWorkspace::exportResult(bool elsewhere) {
  QString path = QSettings().value(kAtlasFile).toString();
  if (elsewhere || path.isEmpty()) {
    path = QFileDialog::getSaveFileName(window_, tr("Export Atlas"), path.isEmpty() ? tr("atlas.png") : path,
                                        tr("Pictures (%1)").arg(QStringLiteral("*.png")));
  }
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += QStringLiteral(".png");
  QSettings().setValue(kAtlasFile, path);
  jobs_->exportAtlas(path);
}

QJsonObject LeafWorkspace::saveView() const {
  QJsonObject view{{QStringLiteral("leaf"), QString::number(leaf().value)},
                   {QStringLiteral("stage"), int(variantsShown_ ? stage_ : pictures_->wanted())},
                   {QStringLiteral("field"), int(stageBar_->field())},
                   {QStringLiteral("opacity"), stageBar_->opacity()}};
  if (!pane_->isFitted()) {
    view[QStringLiteral("zoom")] = pane_->zoom();
    view[QStringLiteral("x")] = pane_->center().x();
    view[QStringLiteral("y")] = pane_->center().y();
  }
  return view;
}

void LeafWorkspace::restoreView(const QJsonObject& view) {
  const AssetId id{view[QStringLiteral("leaf")].toString().toULongLong()};
  if (context_.document.project().leaf(id)) show(id);
  stageBar_->setField(
      model::LeafField(std::clamp(view[QStringLiteral("field")].toInt(0), 0, int(model::LeafField::Margin))));
  const int stage = view[QStringLiteral("stage")].toInt(-1);
  if (stage >= 0 && stage <= int(Stage::Atlas)) setStage(Stage(stage));
  if (view.contains(QStringLiteral("opacity"))) stageBar_->setOpacity(view[QStringLiteral("opacity")].toDouble());
  if (view.contains(QStringLiteral("zoom"))) {
    pane_->setView(view[QStringLiteral("zoom")].toDouble(),
                   {view[QStringLiteral("x")].toDouble(), view[QStringLiteral("y")].toDouble()});
  }
}

bool LeafWorkspace::isSettled() const {
  if (!pictures_->leaf()) return true;
  return !pictures_->isComputing() && !match_->isComputing() && !pane_->base().isNull() && !maps_->isComputing() &&
         !atlas_->isComputing();
}

}  // namespace windfall::widgets
