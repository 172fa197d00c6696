// Leaves on another device: who has the newer state, and how it gets to the other side.
#include "sim/leaf_field.h"
#include "sim/leaf_storage.h"

namespace windfall::sim {

const LeafStorage& LeafField::storage() const {
  fetch();
  return *storage_;
}

void LeafField::useDevice(LeafDeviceMaker maker) {
  fetch();
  maker_ = std::move(maker);
  makeDevice();
}

void LeafField::makeDevice() {
  behind_ = countsBehind_ = false;
  ahead_ = true;
  device_ = maker_ ? maker_(*storage_) : nullptr;
}

/// True where the device made the step; the host's arrays have still to change sides.
bool LeafField::stepOnDevice(const LeafStep& step) {
  if (!device_) return false;
  if (ahead_ && device_->upload(storage_->arrays, storage_->block())) {
    ahead_ = false;
    sides_ = storage_->swapped;
  }
  if (!ahead_ && device_->step(step)) {
    behind_ = countsBehind_ = true;
    return true;
  }
  fetch();
  device_.reset();
  return false;
}

/// Brings the host's arrays up to date. Where the device has failed they stay as the host last had them.
void LeafField::fetch() const {
  if (!behind_) return;
  behind_ = countsBehind_ = false;
  if (device_->download(storage_->block())) {
    sides_ = storage_->swapped;
    return;
  }
  if (sides_ != storage_->swapped) storage_->swapSides();
  device_.reset();
}

void LeafField::fetchCounts() const {
  if (!countsBehind_) return;
  const LeafArrays& a = storage_->arrays;
  if (device_->counts(*a.totals, {a.lost, storage_->links})) {
    countsBehind_ = false;
  } else {
    fetch();
  }
}

}  // namespace windfall::sim
