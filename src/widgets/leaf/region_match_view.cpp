#include "widgets/leaf/region_match_view.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <algorithm>

#include "model/leaf/region_match.h"
#include "widgets/fields/choice_field.h"
#include "widgets/leaf/leaf_pictures.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

namespace {

/// What one run gives.
struct MatchResult {
  std::shared_ptr<const model::LeafStages> example;
  MipImage photo, examplePicture, targetPicture;
  std::vector<int> match;
};

/// The match of one of the seeds that variants are made with.
std::vector<int> matchOf(const model::LeafStages& target, const model::LeafStages& example, quint64 seed) {
  RandomSequence random(seed, 211);
  return model::chooseRegions(target, example, random);
}

}  // namespace

RegionMatchView::RegionMatchView(model::Document& document, model::JobRunner& jobs, LeafPictures& pictures,
                                 QWidget* parent)
    : QWidget(parent),
      document_(document),
      jobs_(jobs),
      pictures_(pictures),
      pane_(new ImagePane(this)),
      examples_(new ComboBox(this)),
      hint_(new QLabel(this)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(1, 0, 0, 0);
  column->setSpacing(0);
  auto* row = new QHBoxLayout;
  row->setContentsMargins(2 * kGrid, kGrid, 2 * kGrid, kGrid);
  row->addWidget(new QLabel(tr("Example"), this));
  row->addWidget(examples_, 1);
  column->addLayout(row);
  column->addWidget(pane_, 1);
  hint_->setProperty("hint", true);
  hint_->setWordWrap(true);
  hint_->setContentsMargins(2 * kGrid, kGrid, 2 * kGrid, kGrid);
  column->addWidget(hint_);
  examples_->setToolTip(tr("The leaf that lends its colours; with several, variants take them in turn"));
  setMinimumWidth(220);
  hide();
  choose({});
  connect(examples_, &QComboBox::activated, this, &RegionMatchView::setExample);
  connect(&document_, &model::Document::changed, this, &RegionMatchView::whenChanged);
  connect(&pictures_, &LeafPictures::pictureChanged, this, [this] {
    if (active_) compute();
  });
  connect(pane_, &ImagePane::released, this, [this](const ToolEvent& event) { pairWith(event.position); });
}

model::AssetId RegionMatchView::example() const {
  const model::Leaf* leaf = pictures_.leaf();
  if (!leaf) return {};
  return leaf->examples.empty() ? leaf->id : leaf->examples.front();
}

void RegionMatchView::listLeaves() {
  examples_->clear();
  for (const model::Leaf& leaf : document_.project().leaves) {
    examples_->addItem(leaf.id == pictures_.leafId() ? tr("%1 (itself)").arg(leaf.name) : leaf.name,
                       QVariant::fromValue(leaf.id.value));
  }
  examples_->setCurrentIndex(examples_->findData(QVariant::fromValue(example().value)));
}

void RegionMatchView::setActive(bool active) {
  if (active == active_) return;
  active_ = active;
  setVisible(active);
  targetPicture_ = {};
  match_.clear();
  if (active) {
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
                        : tr("Equal colours go together. Click a region of the target first."));
}

void RegionMatchView::setExample(int index) {
  const model::AssetId id{examples_->itemData(index).toULongLong()};
  const model::Leaf* leaf = pictures_.leaf();
  if (!leaf || id == example()) return;
  // The chosen one comes first; others that lend too stay behind it.
  std::vector<model::AssetId> examples = leaf->examples;
  std::erase(examples, id);
  if (!examples.empty()) examples.erase(examples.begin());
  if (id != leaf->id || !examples.empty()) examples.insert(examples.begin(), id);
  document_.setLeaf(leaf->id, &model::Leaf::examples, examples, model::Aspect::LeafExamples, tr("Choose the example"));
}

void RegionMatchView::whenChanged(const model::Change& change) {
  if (!active_) return;
  if (change.aspect == model::Aspect::Everything || change.aspect == model::Aspect::Assets) listLeaves();
  const bool own = change.asset == pictures_.leafId();
  if (change.aspect == model::Aspect::LeafExamples && own) {
    listLeaves();
    compute();
  } else if (change.aspect == model::Aspect::LeafParameters || change.asset == example()) {
    compute();
  }
}

void RegionMatchView::compute() {
  const model::Leaf* leaf = pictures_.leaf();
  const model::Leaf* lender = document_.project().leaf(example());
  if (!leaf || !lender) return;
  model::Leaf target = *leaf, from = *lender;
  target.variants.clear();
  from.variants.clear();
  const bool itself = from.id == target.id;
  const quint64 seed = leaf->variants.empty() ? 1 : leaf->variants.back().seed;
  const quint64 run = running_ = ++lastRun_;
  model::Job* job = jobs_.start<MatchResult>(
      tr("Matching regions of %1").arg(leaf->name), QStringLiteral("region-match"),
      [target = std::move(target), from = std::move(from), itself, seed, known = pictures_.deepestStages(),
       knownExample = stages_](model::Progress& progress) -> Result<MatchResult> {
        MatchResult result;
        Result<model::LeafStages> to = model::computeStages(
            target, itself ? model::Stage::Superpixels : model::Stage::Regions, progress, known.get());
        if (!to) return to.error();
        if (itself) {
          result.example = std::make_shared<model::LeafStages>(*to);
        } else {
          Result<model::LeafStages> its =
              model::computeStages(from, model::Stage::Superpixels, progress, knownExample.get());
          if (!its) return Error{from.name.toStdString() + ": " + its.error().message, its.error().cancelled};
          result.example = std::make_shared<model::LeafStages>(std::move(*its));
        }
        result.match = matchOf(*to, *result.example, seed);
        std::vector<int> own(static_cast<size_t>(result.example->seen.regions.count));
        for (size_t i = 0; i < own.size(); ++i) own[i] = static_cast<int>(i) + 1;
        result.photo = MipImage(result.example->photo);
        result.examplePicture = MipImage(model::regionPicture(*result.example, result.example->seen.regions, own));
        result.targetPicture = MipImage(model::regionPicture(*to, to->grown.regions, result.match));
        return result;
      },
      [this, run](MatchResult result) {
        if (run != running_) return;
        stages_ = result.example;
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
  const model::LeafStages* target = pictures_.stages();
  if (!leaf || !target || !target_ || !stages_) return;
  if (model::regionAt(*stages_, stages_->seen.regions, source) == 0) return;
  const int region = model::regionAt(*target, target->grown.regions, *target_);
  std::vector<model::RegionPair> pairs = leaf->regionPairs;
  std::erase_if(pairs, [&](const model::RegionPair& pair) {
    return model::regionAt(*target, target->grown.regions, pair.target) == region && pair.example == example();
  });
  pairs.push_back({*target_, example(), source});
  choose({});
  document_.setLeaf(leaf->id, &model::Leaf::regionPairs, pairs, model::Aspect::LeafExamples, tr("Match regions"));
}

}  // namespace windfall::widgets
