// Falling leaves on a CUDA device, seen from C++ that knows no CUDA.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "kernels/leaf_arrays.h"
#include "kernels/leaf_display.h"

namespace windfall::cuda {

/// All leaves of a scene on device 0. An error is sticky: every later call does nothing and returns false.
class LeafSolver {
 public:
  /// `host`: the arrays on the host, in a block whose size and start are given; pointers keep their places in the
  /// block.
  LeafSolver(const LeafArrays& host, const std::byte* block, std::size_t bytes, std::size_t links);
  ~LeafSolver();
  LeafSolver(const LeafSolver&) = delete;
  LeafSolver& operator=(const LeafSolver&) = delete;

  /// The whole block to the device, and back; the arrays say which side of the state is the new one.
  bool upload(const LeafArrays& host, const std::byte* block);
  bool download(std::byte* block) const;
  /// One step in one launch. Links and wind of `step` lie on the device (LinkSolver has them); afterwards the two sides
  /// have changed places, as the host's must.
  bool step(const LeafStep& step);
  /// Display state into the host's memory, in one launch. Links of `display` lie on the device where `linksAreHere`,
  /// else on the host.
  bool write(const LeafDisplay& display, bool linksAreHere, std::span<LeafInstance> leaves);
  /// Totals and what each link has lost, after the last step.
  bool counts(LeafTotals& totals, std::span<std::int32_t> lost) const;
  /// Empty, or one line on what went wrong.
  const std::string& problem() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace windfall::cuda
