#include "widgets/leaf/variant_strip.h"

#include <QAction>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QMouseEvent>
#include <QPushButton>
#include <cmath>

#include "widgets/fields/number_field.h"
#include "widgets/leaf/variant_delegate.h"
#include "widgets/leaf/variant_scores.h"
#include "widgets/look/icon.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

using model::Aspect;
using model::Variant;

namespace {

/// Never "-0.0".
double rounded(double value, int decimals) {
  const double unit = std::pow(10.0, decimals);
  return std::round(value * unit) / unit + 0.0;
}

}  // namespace

VariantStrip::VariantStrip(model::Document& document, QWidget* parent)
    : QWidget(parent),
      document_(document),
      list_(new QListWidget(this)),
      make_(new QPushButton(this)),
      count_(new NumberBox(this)),
      hint_(new QLabel(this)),
      summary_(new QLabel(this)) {
  setWindowTitle(tr("Variants"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(3 * kGrid, 0, 3 * kGrid, 2 * kGrid);
  row->setSpacing(3 * kGrid);
  auto* left = new QVBoxLayout;
  left->setSpacing(2 * kGrid);
  auto* countRow = new QHBoxLayout;
  auto* countLabel = new QLabel(tr("How many"), this);
  countLabel->setProperty("hint", true);
  count_->setDecimals(0);
  count_->setRange(1, 64);
  count_->setValue(6);
  count_->setFixedWidth(48);
  countRow->addWidget(countLabel, 1);
  countRow->addWidget(count_);
  make_->setProperty("primary", true);
  make_->setMinimumWidth(140);
  summary_->setProperty("hint", true);
  left->addLayout(countRow);
  left->addWidget(make_);
  left->addWidget(summary_);
  left->addStretch(1);
  row->addLayout(left);

  list_->setViewMode(QListView::IconMode);
  list_->setFlow(QListView::LeftToRight);
  list_->setWrapping(false);
  list_->setMovement(QListView::Static);
  list_->setUniformItemSizes(true);
  list_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  list_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  list_->setItemDelegate(new VariantDelegate(list_));
  list_->setMouseTracking(true);
  list_->setMinimumHeight(152);
  list_->viewport()->installEventFilter(this);
  row->addWidget(list_, 1);
  hint_->setProperty("hint", true);
  hint_->setAlignment(Qt::AlignCenter);
  hint_->setWordWrap(true);
  row->addWidget(hint_, 1);

  auto* remove = new QAction(icon(QStringLiteral("delete")), tr("Delete"), list_);
  remove->setShortcut(QKeySequence::Delete);
  remove->setShortcutContext(Qt::WidgetShortcut);
  list_->addAction(remove);
  list_->setContextMenuPolicy(Qt::ActionsContextMenu);
  connect(remove, &QAction::triggered, this, &VariantStrip::removeSelected);
  connect(make_, &QPushButton::clicked, this, [this] { emit makeRequested(int(count_->value())); });
  connect(count_, &QDoubleSpinBox::valueChanged, this, &VariantStrip::updateButton);
  connect(list_, &QListWidget::currentRowChanged, this, [this](int index) {
    if (index >= 0) emit chosen(index);
  });
  connect(list_, &QListWidget::itemDoubleClicked, this,
          [this](QListWidgetItem* item) { emit opened(list_->row(item)); });
  connect(&document_, &model::Document::changed, this, [this](const model::Change& change) {
    if (change.aspect == Aspect::Everything || (change.asset == leaf_ && change.aspect == Aspect::LeafVariants)) {
      refresh();
    }
  });
  refresh();
}

void VariantStrip::setLeaf(model::AssetId leaf) {
  leaf_ = leaf;
  refresh();
}

int VariantStrip::current() const { return list_->currentRow(); }

void VariantStrip::select(int index) { list_->setCurrentRow(index); }

void VariantStrip::setBusy(bool busy) {
  busy_ = busy;
  updateButton();
}

void VariantStrip::setScores(VariantScores* scores) {
  scores_ = scores;
  connect(scores_, &VariantScores::changed, this, &VariantStrip::showScores);
  scores_->want(leaf_);
  showScores();
}

void VariantStrip::showScores() {
  const model::Leaf* leaf = document_.project().leaf(leaf_);
  for (std::size_t i = 0; leaf && i < leaf->variants.size() && int(i) < list_->count(); ++i) {
    const Variant& variant = leaf->variants[i];
    QString tip = tr("Seed %1. The heart takes it into the atlas and onto the trees.").arg(variant.seed);
    QString line;
    if (const auto score = scores_ ? scores_->of(variant) : std::nullopt) {
      line = tr("Q %1 · %2 · Δ %3")
                 .arg(score->quality, 0, 'f', 0)
                 .arg(rounded(score->copyIndex, 1), 0, 'f', 1)
                 .arg(score->diversity, 0, 'f', 0);
      tip += QLatin1Char('\n') + tr("Quality %1 of 100: colour, texture, details and veins beside the photo's own")
                                     .arg(score->quality, 0, 'f', 1);
      tip += QLatin1Char('\n') +
             tr("Copy index %1: 0.9 and more is the photo itself").arg(rounded(score->copyIndex, 2), 0, 'f', 2);
      tip += QLatin1Char('\n') +
             tr("Diversity ΔE %1: how unlike the variant before it is").arg(score->diversity, 0, 'f', 1);
    }
    QListWidgetItem* item = list_->item(int(i));
    item->setData(kVariantScore, line);
    item->setToolTip(tip);
  }
}

void VariantStrip::updateButton() {
  const int count = int(count_->value());
  make_->setText(busy_        ? tr("Making variants…")
                 : count == 1 ? tr("Make a variant")
                              : tr("Make %n variants", nullptr, count));
  make_->setEnabled(!busy_ && document_.project().leaf(leaf_));
}

void VariantStrip::refresh() {
  const QSignalBlocker blocker(list_);
  const int row = list_->currentRow();
  list_->clear();
  const model::Leaf* leaf = document_.project().leaf(leaf_);
  int kept = 0;
  for (std::size_t i = 0; leaf && i < leaf->variants.size(); ++i) {
    const Variant& variant = leaf->variants[i];
    auto* item = new QListWidgetItem(list_);
    item->setData(kVariantImage, variant.image);
    item->setData(kVariantKeep, variant.keep);
    item->setData(kVariantSeed, QVariant::fromValue(variant.seed));
    kept += variant.keep;
  }
  if (scores_) scores_->want(leaf_);
  showScores();
  if (list_->count() > 0) list_->setCurrentRow(std::clamp(row, 0, list_->count() - 1));
  list_->setVisible(list_->count() > 0);
  hint_->setVisible(list_->count() == 0);
  hint_->setText(leaf ? tr("No variants yet: each is a new texture in the shape of this leaf.")
                      : tr("Variants of a leaf appear here."));
  summary_->setText(list_->count() ? tr("%1 of %2 kept").arg(kept).arg(list_->count()) : QString());
  updateButton();
}

void VariantStrip::toggleKeep(int index) {
  const model::Leaf* leaf = document_.project().leaf(leaf_);
  if (!leaf || index < 0 || std::size_t(index) >= leaf->variants.size()) return;
  std::vector<Variant> variants = leaf->variants;
  variants[std::size_t(index)].keep = !variants[std::size_t(index)].keep;
  document_.setLeaf(leaf_, &model::Leaf::variants, variants, Aspect::LeafVariants,
                    variants[std::size_t(index)].keep ? tr("Keep variant") : tr("Drop variant"));
}

void VariantStrip::removeSelected() {
  const model::Leaf* leaf = document_.project().leaf(leaf_);
  if (!leaf) return;
  std::vector<Variant> left;
  for (std::size_t i = 0; i < leaf->variants.size(); ++i) {
    if (!list_->item(int(i))->isSelected()) left.push_back(leaf->variants[i]);
  }
  document_.setLeaf(leaf_, &model::Leaf::variants, left, Aspect::LeafVariants, tr("Delete variants"));
}

bool VariantStrip::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::MouseButtonPress) {
    const QPoint at = static_cast<QMouseEvent*>(event)->position().toPoint();
    const QListWidgetItem* item = list_->itemAt(at);
    if (item && VariantDelegate::heartOf(list_->visualItemRect(item)).contains(at)) {
      toggleKeep(list_->row(item));
      return true;
    }
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace windfall::widgets
