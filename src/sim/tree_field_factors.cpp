// How a field comes to its constants: at once, or beside the steps.
#include <algorithm>

#include "kernels/link_forces.h"
#include "kernels/link_modal.h"
#include "sim/tree_field.h"

namespace windfall::sim {

namespace {
constexpr std::size_t kVisitsAStep = 2048;  // of a small field
}

/// Writes a tree's constants into slots.
class TreeField::Sink final : public ConstantSink {
 public:
  Sink(const TreeField& field, std::size_t first, AlignedVector<float>& constants, std::vector<LinkInertia>& inertia)
      : field_(field), first_(first), constants_(constants), inertia_(inertia) {}

  void put(std::size_t link, std::uint32_t first, std::span<const double> constants) override {
    const SlotFields<float> fields =
        fieldsOf(constants_.data(), field_.constantFields_, field_.slots_.slot[first_ + link]);
    const auto end = std::min(field_.constantFields_, first + static_cast<std::uint32_t>(constants.size()));
    for (std::uint32_t f = first; f < end; ++f) fields.put(f, static_cast<float>(constants[f - first]));
  }
  void put(std::size_t link, const LinkInertia& inertia) override { inertia_[first_ + link] = inertia; }

 private:
  const TreeField& field_;
  std::size_t first_;
  AlignedVector<float>& constants_;
  std::vector<LinkInertia>& inertia_;
};

/// Slots without a link divide by their stiffness too.
void TreeField::initialise(AlignedVector<float>& constants) {
  for (std::size_t i = 0; i < slots_.link.size(); ++i) {
    if (slots_.link[i] < slots_.links) continue;
    const SlotFields<float> fields = fieldsOf(constants.data(), constantFields_, static_cast<std::uint32_t>(i));
    for (const std::uint32_t one : {std::uint32_t{kBending}, std::uint32_t{kTwist}, kRestTurn + 3u}) fields.put(one, 1);
    if (isModal(settings_.method)) {
      for (std::uint32_t a = 0; a < 3; ++a) fields.put(kSquares + a, 1);
    } else if (settings_.method == TreeMethod::Forces) {
      fields.put(kInertia, 1);
      fields.put(kTwistInertia, 1);
    }
  }
}

FactorInput TreeField::inputOf(std::size_t instance, const FactorSettings& settings,
                               std::span<const float> lostArea) const {
  const Tree& tree = *trees_[instance].tree;
  return {&tree, Ground(trees_[instance].placement), lostArea.subspan(firstLinks_[instance], tree.links.size()),
          frequencies_[instance], settings};
}

void TreeField::factoriseTree(std::size_t instance) {
  FactorPass& factors = *factors_[instance];
  factors.begin(inputOf(instance, settings_, lostArea_));
  Sink sink(*this, firstLinks_[instance], constants_, inertia_);
  std::size_t visits = factors.visits();
  factors.advance(visits, sink);
}

void TreeField::factorise(const FactorSettings& settings) {
  // The method was chosen once: it decides what is stored.
  const TreeMethod method = settings_.method;
  const bool axisMotion = settings_.axisMotion;
  settings_ = settings;
  settings_.method = method;
  settings_.axisMotion = axisMotion;
  renewing_ = false;
  ++revision_;
  const auto count = static_cast<std::ptrdiff_t>(trees_.size());
#pragma omp parallel for schedule(dynamic) num_threads(threads_) if (count > 1)
  for (std::ptrdiff_t t = 0; t < count; ++t) factoriseTree(static_cast<std::size_t>(t));
}

void TreeField::setLostArea(std::span<const float> area) {
  std::copy(area.begin(), area.end(), lostArea_.begin());
  factorise(settings_);
  for (std::size_t i = 0; i < size(); ++i) toModes(i);
}

void TreeField::setTree(std::size_t instance, std::shared_ptr<const Tree> tree) {
  trees_[instance].tree = std::move(tree);
  frequencies_[instance] = settings_.frequency > 0 ? settings_.frequency : firstFrequency(*trees_[instance].tree);
  ++revision_;
  factoriseTree(instance);
  const std::size_t first = firstLinks_[instance];
  for (std::size_t i = 0; i < trees_[instance].tree->links.size(); ++i) toModes(first + i);
  if (renewing_) beginRenewal();
}

void TreeField::renew(const FactorSettings& settings, std::span<const float> lostArea) {
  if (renewing_) return;
  nextSettings_ = settings_;
  nextSettings_.windSpeed = settings.windSpeed;
  nextSettings_.windDirection = settings.windDirection;
  std::copy(lostArea.begin(), lostArea.end(), nextLostArea_.begin());
  beginRenewal();
}

void TreeField::beginRenewal() {
  renewing_ = true;
  pieces_ = 0;
  std::size_t visits = 0;
  for (std::size_t t = 0; t < trees_.size(); ++t) {
    factors_[t]->begin(inputOf(t, nextSettings_, nextLostArea_));
    visits += factors_[t]->visits();
    made_[t] = 0;
  }
  pieceSteps_ = std::clamp<std::size_t>(visits / kVisitsAStep, 1, kFactorSteps);
}

bool TreeField::renewOn(std::size_t instance) {
  if (made_[instance] != 0) return true;
  FactorPass& factors = *factors_[instance];
  std::size_t visits = (factors.visits() + pieceSteps_ - 1) / pieceSteps_;
  Sink sink(*this, firstLinks_[instance], nextConstants_, nextInertia_);
  if (factors.advance(visits, sink)) made_[instance] = 1;
  return made_[instance] != 0;
}

void TreeField::renewOn() {
  if (!renewing_) return;
  const auto count = static_cast<std::ptrdiff_t>(trees_.size());
#pragma omp parallel for schedule(dynamic) num_threads(threads_) if (count > 1)
  for (std::ptrdiff_t t = 0; t < count; ++t) renewOn(static_cast<std::size_t>(t));
  takeFactors();
}

/// At the end of a piece: once all are made they are taken.
void TreeField::takeFactors() {
  ++pieces_;
  if (std::find(made_.begin(), made_.end(), 0) != made_.end()) return;
  renewing_ = false;
  ++revision_;
  settings_ = nextSettings_;
  constants_.swap(nextConstants_);
  inertia_.swap(nextInertia_);
  const bool lighter = lostArea_ != nextLostArea_;
  lostArea_.swap(nextLostArea_);
  // The wind changes dampings alone; where masses change so do the modes.
  if (!lighter || !isModal(settings_.method)) return;
  const auto count = static_cast<std::ptrdiff_t>(size());
#pragma omp parallel for schedule(static) num_threads(threads_) if (count > 8192)
  for (std::ptrdiff_t i = 0; i < count; ++i) toModes(static_cast<std::size_t>(i));
}

/// Of the joint's angle and speed, which go on, what its modes make of them.
void TreeField::toModes(std::size_t link) {
  if (!isModal(settings_.method)) return;
  const SlotFields<const float> constant = fieldsOf<const float>(constants_.data(), constantFields_, slots_.slot[link]);
  const SlotFields<float> own = fieldsOf(state_.data(), stateFields_, slots_.slot[link]);
  const V3<float> angle = vectorAt<float>(own, kAngle), speed = vectorAt<float>(own, kSpeed);
  // U^T K U is one, so y = U^T K theta.
  const float k = constant.get(kBending), t = constant.get(kTwist);
  for (std::uint32_t a = 0; a < 3; ++a) {
    const V3<float> u = vectorAt<float>(constant, kModes + 3 * a);
    own.put(kMode + a, u.x * k * angle.x + u.y * k * angle.y + u.z * t * angle.z);
    own.put(kModeSpeed + a, u.x * k * speed.x + u.y * k * speed.y + u.z * t * speed.z);
  }
}

TreeField::Renewal TreeField::renewal() const {
  const FactorSettings& next = renewing_ ? nextSettings_ : settings_;
  Renewal now;
  now.windSpeed = settings_.windSpeed;
  now.nextWindSpeed = next.windSpeed;
  for (int k = 0; k < 3; ++k) {
    now.direction[k] = settings_.windDirection[k];
    now.nextDirection[k] = next.windDirection[k];
  }
  if (renewing_) now.pieces = pieces_;
  return now;
}

void TreeField::resume(const Renewal& saved, std::span<const float> lostArea, std::span<const float> nextLostArea) {
  const auto windOf = [&](double speed, const double(&direction)[3]) {
    FactorSettings settings = settings_;
    settings.windSpeed = speed;
    settings.windDirection = {direction[0], direction[1], direction[2]};
    return settings;
  };
  std::copy(lostArea.begin(), lostArea.end(), lostArea_.begin());
  factorise(windOf(saved.windSpeed, saved.direction));
  if (saved.pieces < 0) return;
  renew(windOf(saved.nextWindSpeed, saved.nextDirection), nextLostArea);
  for (std::int64_t piece = 0; piece < saved.pieces && renewing_; ++piece) renewOn();
}

}  // namespace windfall::sim
