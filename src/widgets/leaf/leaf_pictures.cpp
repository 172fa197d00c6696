#include "widgets/leaf/leaf_pictures.h"

#include <algorithm>

#include "model/leaf/stage_picture.h"

namespace windfall::widgets {

using model::Aspect;
using model::Stage;

namespace {

/// Of pictures with lines: about a thousand pixels for a small photo.
int finenessFor(QSize photo) { return std::clamp(1000 / std::max({1, photo.width(), photo.height()}), 1, 6); }

/// An edit waits so long for the next one, ms: dragging a slider is one computation, not thirty.
constexpr int kPatience = 40;

/// The stage before; for the photo the photo itself.
Stage before(Stage stage) { return stage == Stage::Photo ? stage : Stage(int(stage) - 1); }

}  // namespace

LeafPictures::LeafPictures(model::Document& document, model::JobRunner& jobs, QObject* parent)
    : QObject(parent), document_(document), jobs_(jobs) {
  connect(&document_, &model::Document::changed, this, &LeafPictures::whenChanged);
  waiting_.setSingleShot(true);
  waiting_.setInterval(kPatience);
  connect(&waiting_, &QTimer::timeout, this, &LeafPictures::compute);
}

void LeafPictures::schedule() { waiting_.start(); }

void LeafPictures::setField(model::LeafField field) {
  if (field == field_) return;
  field_ = field;
  picture_ = {};
  if (wanted_ == Stage::Distance) compute();
}

Stage LeafPictures::goal() const {
  if (wanted_ == Stage::Variants) return Stage::Superpixels;
  // Direction and side are told region by region.
  if (wanted_ == Stage::Distance && field_ > model::LeafField::VeinDistance) return Stage::Regions;
  return wanted_;
}

void LeafPictures::setLeaf(model::AssetId leaf) {
  if (leaf == id_ && known_) return;
  id_ = leaf;
  ++generation_;
  known_ = false;
  running_ = 0;
  waiting_.stop();
  stages_ = std::make_shared<model::LeafStages>();
  deepest_.reset();
  automaticMask_ = {};
  photo_ = picture_ = {};
  if (const model::Leaf* shown = this->leaf()) parameters_ = shown->parameters;
  emit photoChanged();
  emit pictureChanged();
  emit statesChanged();
  compute();
}

void LeafPictures::want(Stage stage) {
  if (stage == wanted_ && isUpToDate(stage) && !picture_.isNull()) return;
  wanted_ = stage;
  compute();
}

QImage LeafPictures::mask() const {
  const model::Leaf* shown = leaf();
  if (shown && !shown->mask.isNull()) return shown->mask;
  return automaticMask_;
}

StageState LeafPictures::state(Stage stage) const {
  const model::Leaf* shown = leaf();
  if (!shown) return StageState::Unknown;
  if (known_ && stage > valid_ && deepest_ && stage <= deepest_->reached && stage < Stage::Variants)
    return StageState::OutOfDate;
  const model::LeafParameters defaults;
  const model::LeafParameters& now = shown->parameters;
  bool edited = false;
  switch (stage) {
    case Stage::Photo:
      break;
    case Stage::Mask:
      edited = !shown->mask.isNull() || !(now.mask == defaults.mask);
      break;
    case Stage::Contour:
      edited = shown->root || !shown->tips.empty() || now.epsilon != defaults.epsilon;
      break;
    case Stage::Veins:
      edited = !shown->veins.empty() || !(now.veins == defaults.veins);
      break;
    case Stage::Distance:
      edited = !(now.costs == defaults.costs);
      break;
    case Stage::Regions:
      edited = !shown->markers.empty() || !shown->regionPairs.empty() || !(now.regions == defaults.regions);
      break;
    case Stage::Superpixels:
      edited = now.synthesis.superpixels != defaults.synthesis.superpixels;
      break;
    case Stage::Maps:
      if (shown->variants.empty()) return StageState::Unknown;
      return now.maps == defaults.maps && now.ageing == defaults.ageing ? StageState::Automatic : StageState::Edited;
    case Stage::Atlas:
    case Stage::Variants:
      return shown->variants.empty() ? StageState::Unknown : StageState::Automatic;
  }
  if (edited) return StageState::Edited;
  return isUpToDate(stage) ? StageState::Automatic : StageState::Unknown;
}

void LeafPictures::whenChanged(const model::Change& change) {
  if (change.aspect == Aspect::Everything) {
    id_ = {};
    known_ = false;
    return;
  }
  if (change.asset != id_ || !leaf()) return;
  switch (change.aspect) {
    case Aspect::LeafPhoto: {
      const model::AssetId same = id_;
      known_ = false;
      id_ = {};
      setLeaf(same);
      break;
    }
    case Aspect::LeafMask:
      if (known_ && !mask().isNull()) {
        // The artist's mask is at hand, and so is the automatic one after undo.
        valid_ = Stage::Mask;
        ++generation_;
        running_ = 0;
        emit statesChanged();
        showMask(change.dirty);
        if (wanted_ != Stage::Mask) schedule();
      } else {
        invalidate(Stage::Mask);
      }
      break;
    case Aspect::LeafRoot:
      invalidate(Stage::Contour);
      break;
    case Aspect::LeafVeins:
      invalidate(Stage::Veins);
      break;
    case Aspect::LeafMarkers:
      invalidate(Stage::Regions);
      break;
    case Aspect::LeafParameters:
      invalidateParameters();
      break;
    case Aspect::LeafVariants:
      emit statesChanged();
      break;
    default:
      break;
  }
}

void LeafPictures::invalidateParameters() {
  const model::LeafParameters before = std::exchange(parameters_, leaf()->parameters);
  const model::LeafParameters& now = parameters_;
  // The working size is the scale of everything after the veins.
  if (!(before.mask == now.mask) && leaf()->mask.isNull()) {
    automaticMask_ = {};
    return invalidate(Stage::Mask);
  }
  // The ruler and the length are no parameters of a stage, but what it measures depends on them.
  const bool measured =
      stages_ && stages_->made.ruler == leaf()->ruler && stages_->made.bladeLength == leaf()->bladeLength;
  if (before.epsilon != now.epsilon || before.shape.vary != now.shape.vary || !measured)
    return invalidate(Stage::Contour);
  if (!(before.veins == now.veins)) return invalidate(Stage::Veins);
  if (!(before.costs == now.costs) || before.synthesis.size != now.synthesis.size) return invalidate(Stage::Distance);
  if (before.synthesis.superpixels != now.synthesis.superpixels) return invalidate(Stage::Superpixels);
}

void LeafPictures::invalidate(Stage from) {
  valid_ = std::min(valid_, model::Stage(before(from)));
  ++generation_;
  running_ = 0;
  emit statesChanged();
  schedule();
}

void LeafPictures::compute() {
  waiting_.stop();
  const model::Leaf* shown = leaf();
  if (!shown) return;
  // The first look at a leaf shows its photo at once; then the stage that is wanted follows.
  const Stage goal = !known_ ? Stage::Photo : this->goal();
  if (known_ && goal <= valid_ && goal == Stage::Photo) {
    picture_ = {};
    emit pictureChanged();
    return;
  }
  if (known_ && goal == Stage::Mask && !mask().isNull() && valid_ >= Stage::Mask) return showMask({});
  emit statesChanged();
  model::Leaf snapshot = *shown;
  snapshot.variants.clear();
  // The automatic mask is the dearest of the early stages: found once, it is given back.
  if (snapshot.mask.isNull()) snapshot.mask = automaticMask_;
  const bool withPhoto = photo_.isNull();
  const Stage picture = !known_ ? Stage::Photo : wanted_;
  std::shared_ptr<const model::LeafStages> known = known_ ? stages_ : nullptr;
  if (known && goal > valid_ && deepest_ && goal > known->reached) known = deepest_;
  const QString title = goal == Stage::Photo ? tr("Opening %1").arg(shown->name) : tr("Analysing %1").arg(shown->name);
  const quint64 run = running_ = ++lastRun_;
  model::Job* job = jobs_.start<StageResult>(
      title, QStringLiteral("leaf-stages"),
      [snapshot = std::move(snapshot), goal, picture, withPhoto, known = std::move(known),
       enough = known_ && goal <= valid_, field = field_](model::Progress& progress) {
        StageResult result;
        result.stage = goal;
        result.shown = picture;
        result.field = field;
        result.stages = known;
        // Another look at a stage that is known needs its picture alone.
        if (!enough) {
          Result<model::LeafStages> stages = model::computeStages(snapshot, goal, progress, known.get());
          if (!stages) return Result<StageResult>(stages.error());
          result.stages = std::make_shared<model::LeafStages>(std::move(*stages));
        }
        const model::LeafStages& stages = *result.stages;
        if (withPhoto) result.photo = MipImage(stages.photo);
        if (picture == Stage::Mask) {
          result.picture = MipImage(maskTint(stages.mask, stages.mask.rect()));
        } else if (picture == Stage::Distance) {
          result.picture = MipImage(model::fieldPicture(stages, field, result.scale));
        } else if (picture != Stage::Photo && picture != Stage::Variants) {
          result.picture = MipImage(model::fineStagePicture(stages, picture, finenessFor(stages.photo.size())));
        }
        return Result<StageResult>(std::move(result));
      },
      [this, generation = generation_](StageResult result) { take(std::move(result), generation); });
  connect(job, &model::Job::finished, this, [this, run] {
    // Failed or cancelled: what is known stays.
    if (running_ != run) return;
    running_ = 0;
    emit statesChanged();
  });
}

void LeafPictures::take(StageResult result, quint64 generation) {
  // Another leaf is shown, or this one was edited meanwhile.
  if (generation != generation_) return;
  const model::Leaf* shown = leaf();
  if (!shown) return;
  const bool first = !known_;
  running_ = 0;
  if (!result.photo.isNull()) {
    photo_ = std::move(result.photo);
    emit photoChanged();
  }
  // What was computed less far than what is known says nothing new, unless it is newer.
  if (first || result.stages->reached >= stages_->reached || result.stage > valid_) stages_ = result.stages;
  known_ = true;
  valid_ = first ? result.stage : std::max(valid_, result.stage);
  if (valid_ >= Stage::Mask && shown->mask.isNull()) automaticMask_ = stages_->mask;
  if (!deepest_ || stages_->reached >= deepest_->reached) deepest_ = stages_;
  if (result.shown == wanted_ && valid_ >= goal() && (wanted_ != Stage::Distance || result.field == field_)) {
    picture_ = std::move(result.picture);
    scale_ = result.scale;
    emit pictureChanged();
  } else {
    compute();
  }
  emit statesChanged();
}

void LeafPictures::showMask(QRect part) {
  if (wanted_ != Stage::Mask || mask().isNull()) return;
  const QImage shown = mask();
  if (part.isEmpty() || picture_.size() != shown.size()) {
    picture_ = MipImage(maskTint(shown, shown.rect()));
    emit pictureChanged();
  } else {
    emit maskPartChanged(part);
  }
}

QImage LeafPictures::maskTint(const QImage& mask, QRect part) {
  part &= mask.rect();
  QImage tint(part.size(), QImage::Format_ARGB32_Premultiplied);
  for (int y = 0; y < part.height(); ++y) {
    const uchar* from = mask.constScanLine(part.top() + y) + part.left();
    auto* to = reinterpret_cast<QRgb*>(tint.scanLine(y));
    for (int x = 0; x < part.width(); ++x) {
      // A dark red of 72 %, as rubylith film covers what is masked out.
      const int alpha = (255 - from[x]) * 184 / 255;
      to[x] = qRgba(alpha * 96 / 255, alpha * 14 / 255, alpha * 22 / 255, alpha);
    }
  }
  return tint;
}

}  // namespace windfall::widgets
