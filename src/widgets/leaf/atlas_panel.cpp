#include "widgets/leaf/atlas_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QShowEvent>
#include <algorithm>
#include <cmath>

#include "model/export/atlas_exporter.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/field_panel.h"
#include "widgets/fields/number_field.h"
#include "widgets/leaf/image_pane.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

using model::Aspect;
using model::AtlasSettings;

namespace {
constexpr int kLeastSize = 8, kMostSize = 13;  // powers of two: 256 to 8192
constexpr int kMips = 6;

/// 0: automatic, then the powers of two.
int indexOf(int size) {
  if (size <= 0) return 0;
  return 1 + std::clamp(int(std::lround(std::log2(size))) - kLeastSize, 0, kMostSize - kLeastSize);
}

}  // namespace

AtlasPanel::AtlasPanel(model::Document& document, model::JobRunner& jobs, QWidget* parent)
    : QWidget(parent), document_(document), jobs_(jobs), pane_(new ImagePane(this)) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(0);
  row->addWidget(pane_, 1);
  row->addWidget(buildFields());
  setFocusProxy(pane_);
  connect(&document_, &model::Document::changed, this, [this](const model::Change& change) {
    switch (change.aspect) {
      case Aspect::Atlas:
      case Aspect::Everything:
        refresh();
        [[fallthrough]];
      case Aspect::Assets:
      case Aspect::LeafVariants:
      case Aspect::LeafParameters:
      case Aspect::LeafVeins:
      case Aspect::LeafMask:
      case Aspect::LeafRoot:
        stale_ = true;
        if (isVisible()) pack();
        break;
      default:
        break;
    }
  });
  refresh();
}

QWidget* AtlasPanel::buildFields() {
  const AtlasSettings fresh;
  auto* panel = new FieldPanel(QStringLiteral("atlas"), this);
  panel->setFixedWidth(272);
  FieldGroup* packing = panel->addGroup(QStringLiteral("packing"), tr("Packing"));
  QStringList sizes{tr("Automatic")};
  for (int power = kLeastSize; power <= kMostSize; ++power) sizes << tr("%1 px").arg(1 << power);
  size_ = packing->add(new ChoiceField(tr("Size"), sizes, indexOf(fresh.size)));
  size_->setToolTip(
      tr("Side of the atlas. Automatic: the smallest that holds the leaves as large as they are wanted; leaves are "
         "scaled down together when they do not fit"));
  connect(size_, &ChoiceField::edited, this, [this](int index) {
    edit(tr("Atlas size"), {}, [index](AtlasSettings& s) { s.size = index > 0 ? 1 << (kLeastSize + index - 1) : 0; });
  });
  leafPixels_ = packing->add(new NumberField(
      tr("Largest leaf"),
      {.minimum = 0, .maximum = 4096, .defaultValue = double(fresh.leafPixels), .decimals = 0, .unit = tr("px")}));
  leafPixels_->setToolTip(tr("Wanted long side of the largest leaf in the atlas; 0: as its texture was made"));
  connect(leafPixels_, &NumberField::edited, this, [this](double value) {
    edit(tr("Size of the leaves"), leafPixels_->gesture(), [value](AtlasSettings& s) { s.leafPixels = int(value); });
  });
  packer_ = packing->add(
      new ChoiceField(tr("For"), {tr("Plain files"), tr("glTF"), tr("Unity"), tr("Unreal")}, int(fresh.packer)));
  packer_->setToolTip(tr("How roughness, occlusion and the other maps share the channels of files"));
  connect(packer_, &ChoiceField::edited, this, [this](int index) {
    edit(tr("Atlas packing"), {}, [index](AtlasSettings& s) { s.packer = model::AtlasPacker(index); });
  });
  padding_ = packing->add(new NumberField(
      tr("Padding"),
      {.minimum = 0, .maximum = 128, .defaultValue = double(fresh.padding), .decimals = 0, .unit = tr("px")}));
  padding_->setToolTip(tr("At least so much between two leaves; filled with the leaves' own colours"));
  connect(padding_, &NumberField::edited, this, [this](double value) {
    edit(tr("Padding"), padding_->gesture(), [value](AtlasSettings& s) { s.padding = int(value); });
  });
  mips_ = packing->add(new NumberField(
      tr("Clean mips"), {.minimum = 0, .maximum = 6, .defaultValue = double(fresh.mipLevels), .decimals = 0}));
  mips_->setToolTip(tr("Mip levels in which no leaf may touch its neighbour: 8 px between them, doubled for each"));
  connect(mips_, &NumberField::edited, this, [this](double value) {
    edit(tr("Clean mips"), mips_->gesture(), [value](AtlasSettings& s) { s.mipLevels = int(value); });
  });
  rotate_ = packing->add(new CheckField(tr("Rotate leaves"), fresh.rotate));
  rotate_->setToolTip(tr("Leaves may lie on their side where that packs better"));
  connect(rotate_, &CheckField::edited, this,
          [this](bool value) { edit(tr("Rotate leaves"), {}, [value](AtlasSettings& s) { s.rotate = value; }); });

  FieldGroup* look = panel->addGroup(QStringLiteral("look"), tr("Look at"));
  map_ = look->add(new ChoiceField(
      tr("Map"), {tr("Colour"), tr("Normal"), tr("Height"), tr("Roughness"), tr("Translucency"), tr("Occlusion")}, 0));
  map_->setToolTip(tr("Which of the atlas's maps is shown"));
  QStringList levels{tr("Full size")};
  for (int level = 1; level <= kMips; ++level) levels << tr("Mip %1").arg(level);
  mip_ = look->add(new ChoiceField(tr("Level"), levels, 0));
  mip_->setToolTip(tr("As seen from far away: halved so many times, coverage kept"));
  ground_ = look->add(new ChoiceField(tr("Ground"), {tr("Checkerboard"), tr("Dark"), tr("White")}, 0));
  ground_->setToolTip(tr("What lies behind the leaves; halos show on dark or on white"));
  outlines_ = look->add(new CheckField(tr("Rectangles"), true));
  outlines_->setToolTip(tr("Where each leaf lies, and its petiole's end"));
  for (ChoiceField* field : {map_, mip_, ground_})
    connect(field, &ChoiceField::edited, this, [this] { showPicture(); });
  connect(outlines_, &CheckField::edited, this, [this] { showPicture(); });

  FieldGroup* out = panel->addGroup(QStringLiteral("out"), tr("Export"));
  note_ = new QLabel(panel);
  note_->setWordWrap(true);
  note_->setProperty("hint", true);
  out->addWidget(note_);
  QPushButton* again = out->addButton(tr("Export"), QStringLiteral("export"));
  again->setToolTip(tr("Writes the atlas where it went last (Ctrl+E)"));
  connect(again, &QPushButton::clicked, this, [this] { emit exportRequested(false); });
  QPushButton* elsewhere = out->addButton(tr("Export elsewhere…"));
  elsewhere->setToolTip(tr("Asks for a place first (Ctrl+Shift+E)"));
  connect(elsewhere, &QPushButton::clicked, this, [this] { emit exportRequested(true); });
  return panel;
}

void AtlasPanel::edit(const QString& text, const QString& merge, const std::function<void(AtlasSettings&)>& change) {
  AtlasSettings settings = document_.project().atlas;
  change(settings);
  document_.setAtlas(settings, text, merge);
}

void AtlasPanel::refresh() {
  const AtlasSettings& now = document_.project().atlas;
  size_->setValue(indexOf(now.size));
  leafPixels_->setValue(now.leafPixels);
  packer_->setValue(int(now.packer));
  padding_->setValue(now.padding);
  mips_->setValue(now.mipLevels);
  rotate_->setValue(now.rotate);
}

void AtlasPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (stale_) pack();
}

void AtlasPanel::pack() {
  stale_ = false;
  const model::Project& project = document_.project();
  const bool any = std::any_of(project.leaves.begin(), project.leaves.end(), [](const model::Leaf& leaf) {
    return std::any_of(leaf.variants.begin(), leaf.variants.end(), [](const model::Variant& v) { return v.keep; });
  });
  if (!any) {
    running_ = 0;
    atlas_.reset();
    note_->setText(tr("No variant is kept yet. Make some, and give a heart to those that you like."));
    return showPicture();
  }
  const quint64 run = running_ = ++lastRun_;
  using Packed = std::shared_ptr<const model::Atlas>;
  model::Job* job = jobs_.start<Packed>(
      tr("Packing the atlas"), QStringLiteral("atlas-preview"),
      [project](model::Progress& progress) -> Result<Packed> {
        Result<model::Atlas> atlas = model::packKept(project, {}, project.atlas, progress);
        if (!atlas) return atlas.error();
        return Packed(std::make_shared<model::Atlas>(std::move(*atlas)));
      },
      [this, run](const Packed& packed) {
        if (run != running_) return;
        atlas_ = packed;
        const int scale = qRound(100 * atlas_->scale);
        note_->setText(tr("Leaves: %1, at %2 % of their size\nAtlas: %3 × %4 px")
                           .arg(atlas_->places.size())
                           .arg(scale)
                           .arg(atlas_->image.width())
                           .arg(atlas_->image.height()));
        showPicture();
      });
  connect(job, &model::Job::finished, this, [this, run] {
    if (run == running_) running_ = 0;
  });
}

void AtlasPanel::showPicture() {
  if (!atlas_) {
    pane_->setBase({});
    return pane_->setOverlay({});
  }
  const model::LeafMaps& maps = atlas_->maps;
  const QImage* all[] = {&atlas_->image,  &maps.normal,       &maps.height,
                         &maps.roughness, &maps.translucency, &maps.occlusion};
  QImage picture = *all[std::clamp(map_->value(), 0, 5)];
  const QSize full = atlas_->image.size();
  if (picture.isNull()) picture = atlas_->image;
  if (map_->value() <= 0 && mip_->value() > 0) {
    const std::vector<QImage> levels = model::mipLevels(picture, mip_->value());
    if (!levels.empty()) picture = levels.back().scaled(full);
  }
  picture = picture.convertToFormat(QImage::Format_ARGB32_Premultiplied);
  if (ground_->value() > 0) {
    QImage ground(full, QImage::Format_ARGB32_Premultiplied);
    ground.fill(ground_->value() == 1 ? QColor(18, 18, 20) : QColor(Qt::white));
    QPainter(&ground).drawImage(0, 0, picture);
    picture = ground;
  }
  if (outlines_->value()) {
    QPainter painter(&picture);
    painter.setRenderHint(QPainter::Antialiasing);
    const double unit = full.width() / 1000.0;
    const QColor accent = colors(palette()).accent;
    for (std::size_t i = 0; i < atlas_->places.size(); ++i) {
      painter.setPen(QPen(accent, 1.5 * unit));
      painter.setBrush(Qt::NoBrush);
      painter.drawRect(QRectF(atlas_->places[i]));
      const QPointF pivot = atlas_->toAtlas(i, atlas_->textures[i].pivot);
      painter.setBrush(accent);
      painter.drawEllipse(QPointF(pivot.x() * full.width(), pivot.y() * full.height()), 4 * unit, 4 * unit);
    }
  }
  pane_->setBaseVisible(false);
  pane_->setBase(MipImage(picture));
  pane_->setOverlayOpacity(1);
  pane_->setOverlay(MipImage(picture));
}

}  // namespace windfall::widgets
