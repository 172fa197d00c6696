// Leaves that are stepped elsewhere than on the host: what LeafField asks of a device.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "kernels/leaf_arrays.h"
#include "kernels/leaf_display.h"

namespace windfall::sim {

struct LeafStorage;

/// A copy of all leaves on another device. A call returns false once anything has failed there; the field then goes on
/// on the host, from what it fetched last.
class LeafDevice {
 public:
  LeafDevice() = default;
  virtual ~LeafDevice() = default;
  LeafDevice(const LeafDevice&) = delete;
  LeafDevice& operator=(const LeafDevice&) = delete;

  /// The whole block of a LeafStorage to the device, and back; the arrays say which side of the state is the new one.
  virtual bool upload(const LeafArrays& host, const std::byte* block) = 0;
  virtual bool download(std::byte* block) = 0;
  /// One step; afterwards the two sides of the state have changed places, as the host's then do.
  virtual bool step(const LeafStep& step) = 0;
  /// Display state into the host's memory.
  virtual bool write(const LeafDisplay& display, std::span<LeafInstance> leaves) = 0;
  /// Totals and what each link has lost, after the last step.
  virtual bool counts(LeafTotals& totals, std::span<std::int32_t> lost) = 0;
};

/// Makes the device's copy for a storage; null where there is none.
using LeafDeviceMaker = std::function<std::unique_ptr<LeafDevice>(const LeafStorage&)>;

}  // namespace windfall::sim
