#include "widgets/leaf/region_match_view.h"

#include <QLabel>
#include <QListWidget>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "model/leaf/joined_examples.h"
#include "model/leaf/region_match.h"
#include "widgets/leaf/leaf_pictures.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

using model::AssetId;
using model::LeafStages;

namespace {

constexpr int kMostRows = 5;

/// What one run gives.
struct MatchResult {
  std::map<AssetId, std::shared_ptr<const LeafStages>> known;
  MipImage photo, examplePicture, targetPicture;
  std::vector<int> match;
};

/// The match of one of the seeds that variants are made with.
std::vector<int> matchOf(const LeafStages& target, const LeafStages& example, quint64 seed) {
  RandomSequence random(seed, 211);
  return model::chooseRegions(target, example, random);
}

/// The numbers of a leaf's regions among those of the example that it is part of; empty: it is no part of it.
std::vector<int> numbersIn(const LeafStages& example, const LeafStages& leaf) {
  const model::LabelField& own = leaf.seen.regions;
  std::vector<int> numbers;
  int before = 0;
  bool found = example.joined.empty();
  for (const model::JoinedLeaf& part : example.joined) {
    if (part.id == leaf.made.id) before = part.before, found = true;
  }
  if (!found) return numbers;
  for (int n = 1; n <= own.count; ++n) {
    numbers.push_back(n == own.petiole && !example.joined.empty() ? example.seen.regions.petiole : before + n);
  }
  return numbers;
}

}  // namespace

RegionMatchView::RegionMatchView(model::Document& document, model::JobRunner& jobs, LeafPictures& pictures,
                                 QWidget* parent)
    : QWidget(parent),
      document_(document),
      jobs_(jobs),
      pictures_(pictures),
      pane_(new ImagePane(this)),
      list_(new QListWidget(this)),
      hint_(new QLabel(this)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(1, 0, 0, 0);
  column->setSpacing(0);
  auto* title = new QLabel(tr("Colours from"), this);
  title->setContentsMargins(2 * kGrid, kGrid, 2 * kGrid, kGrid);
  title->setBuddy(list_);
  column->addWidget(title);
  column->addWidget(list_);
  column->addWidget(pane_, 1);
  hint_->setProperty("hint", true);
  hint_->setWordWrap(true);
  hint_->setContentsMargins(2 * kGrid, kGrid, 2 * kGrid, kGrid);
  column->addWidget(hint_);
  list_->setToolTip(
      tr("Leaves with a tick lend their colours; with several, each region takes those of one of them.\n"
         "Click a name to see that leaf below."));
  list_->setStyleSheet(QStringLiteral("QListWidget { padding-left: %1px; }").arg(kGrid));
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setMinimumWidth(220);
  hide();
  choose({});
  connect(list_, &QListWidget::currentRowChanged, this, &RegionMatchView::show);
  connect(list_, &QListWidget::itemChanged, this, &RegionMatchView::whenTicked);
  connect(&document_, &model::Document::changed, this, &RegionMatchView::whenChanged);
  connect(&pictures_, &LeafPictures::pictureChanged, this, [this] {
    if (active_) compute();
  });
  connect(pane_, &ImagePane::released, this, [this](const ToolEvent& event) { pairWith(event.position); });
}

std::vector<AssetId> RegionMatchView::lenders() const {
  const model::Leaf* leaf = pictures_.leaf();
  if (!leaf) return {};
  return leaf->examples.empty() ? std::vector<AssetId>{leaf->id} : leaf->examples;
}

AssetId RegionMatchView::example() const {
  if (document_.project().leaf(shown_)) return shown_;
  const std::vector<AssetId> all = lenders();
  return all.empty() ? AssetId() : all.front();
}

void RegionMatchView::listLeaves() {
  const QSignalBlocker quiet(list_);
  const std::vector<model::Leaf>& leaves = document_.project().leaves;
  const std::vector<AssetId> lending = lenders();
  // Rows stay where they can: this may be the answer to a tick in one of them.
  while (list_->count() > int(leaves.size())) delete list_->takeItem(list_->count() - 1);
  while (list_->count() < int(leaves.size())) new QListWidgetItem(list_);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const model::Leaf& leaf = leaves[i];
    QListWidgetItem* item = list_->item(int(i));
    item->setText(leaf.id == pictures_.leafId() ? tr("%1 (itself)").arg(leaf.name) : leaf.name);
    item->setData(Qt::UserRole, QVariant::fromValue(leaf.id.value));
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    const bool lends = std::find(lending.begin(), lending.end(), leaf.id) != lending.end();
    item->setCheckState(lends ? Qt::Checked : Qt::Unchecked);
    if (leaf.id == example()) list_->setCurrentItem(item);
  }
  const int rows = std::clamp(list_->count(), 1, kMostRows);
  list_->setFixedHeight(rows * std::max(24, list_->sizeHintForRow(0)) + 2 * list_->frameWidth());
}

void RegionMatchView::setActive(bool active) {
  if (active == active_) return;
  active_ = active;
  setVisible(active);
  targetPicture_ = {};
  match_.clear();
  if (active) {
    shown_ = {};
    listLeaves();
    compute();
  } else {
    running_ = 0;
    choose({});
    emit pictureChanged();
  }
}

void RegionMatchView::choose(std::optional<QPointF> target) {
  target_ = target;
  hint_->setText(target ? tr("Now click the region here that shall lend its colours.")
                        : tr("Equal colours go together, pale ones with another leaf. Click a region of the target "
                             "first."));
}

void RegionMatchView::setLenders(std::vector<AssetId> lenders) {
  const model::Leaf* leaf = pictures_.leaf();
  if (!leaf) return;
  // None, or the leaf alone, is the same.
  if (lenders.size() == 1 && lenders.front() == leaf->id) lenders.clear();
  document_.setLeaf(leaf->id, &model::Leaf::examples, lenders, model::Aspect::LeafExamples, tr("Choose examples"));
}

void RegionMatchView::whenTicked(QListWidgetItem* item) {
  const AssetId id{item->data(Qt::UserRole).toULongLong()};
  std::vector<AssetId> lending = lenders();
  std::erase(lending, id);
  if (item->checkState() == Qt::Checked) lending.push_back(id);
  // One that lends no longer makes room for one that does.
  shown_ = item->checkState() == Qt::Checked ? id : AssetId();
  setLenders(lending);
  listLeaves();
  compute();
}

void RegionMatchView::show(int row) {
  if (row < 0) return;
  shown_ = AssetId{list_->item(row)->data(Qt::UserRole).toULongLong()};
  compute();
}

void RegionMatchView::whenChanged(const model::Change& change) {
  if (!active_) return;
  const bool own = change.asset == pictures_.leafId();
  if (change.aspect == model::Aspect::Everything || change.aspect == model::Aspect::Assets) listLeaves();
  const std::vector<AssetId> lending = lenders();
  if (change.aspect == model::Aspect::LeafExamples && own) {
    listLeaves();
    compute();
  } else if (change.aspect == model::Aspect::LeafParameters || change.asset == example() ||
             std::find(lending.begin(), lending.end(), change.asset) != lending.end()) {
    compute();
  }
}

void RegionMatchView::compute() {
  const model::Leaf* leaf = pictures_.leaf();
  if (!leaf) return;
  model::Leaf target = *leaf;
  target.variants.clear();
  // In the order of the examples, as variants have them; the one shown last if it lends nothing.
  std::vector<model::Leaf> leaves;
  for (const AssetId id : lenders()) {
    if (const model::Leaf* lender = document_.project().leaf(id)) leaves.push_back(*lender);
  }
  const std::size_t lending = leaves.size();
  const AssetId shown = example();
  const auto isShown = [shown](const model::Leaf& one) { return one.id == shown; };
  if (std::none_of(leaves.begin(), leaves.end(), isShown)) {
    if (const model::Leaf* other = document_.project().leaf(shown)) leaves.push_back(*other);
  }
  if (leaves.empty()) return;
  for (model::Leaf& one : leaves) one.variants.clear();
  const quint64 seed = leaf->variants.empty() ? 1 : leaf->variants.back().seed;
  const quint64 run = running_ = ++lastRun_;
  model::Job* job = jobs_.start<MatchResult>(
      tr("Matching regions of %1").arg(leaf->name), QStringLiteral("region-match"),
      [target = std::move(target), leaves = std::move(leaves), lending, shown, seed,
       knownTarget = pictures_.deepestStages(),
       knownExamples = known_](model::Progress& progress) -> Result<MatchResult> {
        MatchResult result;
        const bool itself =
            std::any_of(leaves.begin(), leaves.end(), [&](const model::Leaf& one) { return one.id == target.id; });
        Result<LeafStages> to = model::computeStages(target, itself ? model::Stage::Superpixels : model::Stage::Regions,
                                                     progress, knownTarget.get());
        if (!to) return to.error();
        std::vector<LeafStages> examples;
        for (std::size_t i = 0; i < leaves.size(); ++i) {
          const model::Leaf& one = leaves[i];
          const auto known = knownExamples.find(one.id);
          Result<LeafStages> its =
              one.id == target.id ? Result<LeafStages>(*to)
                                  : model::computeStages(one, model::Stage::Superpixels, progress,
                                                         known == knownExamples.end() ? nullptr : known->second.get());
          if (!its) return Error{one.name.toStdString() + ": " + its.error().message, its.error().cancelled};
          if (i < lending) examples.push_back(*its);
          result.known[one.id] = std::make_shared<LeafStages>(std::move(*its));
        }
        const LeafStages& looked = *result.known.at(shown);
        // Where variants take examples in turn the match is with the one that is shown.
        examples = model::lendersOf(*to, std::move(examples));
        const LeafStages& example = examples.size() == 1 ? examples.front() : looked;
        result.match = matchOf(*to, example, seed);
        std::vector<int> own = numbersIn(example, looked), colours = result.match;
        if (example.joined.empty() && looked.made.id != example.made.id) own.clear();
        for (int& number : colours) {
          if (std::find(own.begin(), own.end(), number) == own.end()) number = -number;
        }
        if (own.empty()) {
          // It lends nothing: numbers that nobody has, pale.
          for (int n = 1; n <= looked.seen.regions.count; ++n) own.push_back(-(example.seen.regions.count + n));
        }
        result.photo = MipImage(looked.photo);
        result.examplePicture = MipImage(model::regionPicture(looked, looked.seen.regions, own));
        result.targetPicture = MipImage(model::regionPicture(*to, to->grown.regions, colours));
        return result;
      },
      [this, run](MatchResult result) {
        if (run != running_) return;
        known_ = std::move(result.known);
        match_ = std::move(result.match);
        targetPicture_ = std::move(result.targetPicture);
        pane_->setBase(std::move(result.photo));
        pane_->setOverlayOpacity(0.85);
        pane_->setOverlay(std::move(result.examplePicture));
        emit pictureChanged();
      });
  connect(job, &model::Job::finished, this, [this, run] {
    if (running_ == run) running_ = 0;
  });
}

void RegionMatchView::pairWith(QPointF source) {
  const model::Leaf* leaf = pictures_.leaf();
  const LeafStages* target = pictures_.stages();
  const AssetId from = example();
  const auto known = known_.find(from);
  if (!leaf || !target || !target_ || known == known_.end()) return;
  if (model::regionAt(*known->second, known->second->seen.regions, source) == 0) return;
  const int region = model::regionAt(*target, target->grown.regions, *target_);
  // With several examples in one texture a region has one partner among all of them.
  const bool mixed = leaf->parameters.regions.mix;
  std::vector<model::RegionPair> pairs = leaf->regionPairs;
  std::erase_if(pairs, [&](const model::RegionPair& pair) {
    return model::regionAt(*target, target->grown.regions, pair.target) == region && (mixed || pair.example == from);
  });
  pairs.push_back({*target_, from, source});
  choose({});
  const AssetId id = leaf->id;
  std::vector<AssetId> lending = lenders();
  const bool joins = std::find(lending.begin(), lending.end(), from) == lending.end();
  if (joins) document_.undoStack().beginMacro(tr("Match regions"));
  if (joins) {
    lending.push_back(from);
    setLenders(lending);
  }
  document_.setLeaf(id, &model::Leaf::regionPairs, pairs, model::Aspect::LeafExamples, tr("Match regions"));
  if (joins) document_.undoStack().endMacro();
}

}  // namespace windfall::widgets
