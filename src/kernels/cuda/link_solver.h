// The tree solvers on a CUDA device, seen from C++ that knows no CUDA.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "kernels/link_slots.h"
#include "kernels/wind.h"

namespace windfall::cuda {

/// Names of the usable devices; empty where there is none. `problem` says why, in one line.
std::vector<std::string> deviceNames(std::string* problem = nullptr);

enum class LinkMethod { Coupled, Modal, Axis, Forces };

/// How a forest's slots are worked through: every part in rounds of `width` slots that do not wait for each other.
/// Part 0 holds the links above all treelets.
struct Forest {
  LinkMethod method = LinkMethod::Coupled;
  std::uint32_t width = 128;
  std::uint32_t rows = 0;                                               ///< of poses
  std::uint32_t sumRow = 0;                                             ///< numbers of a row of sums
  std::vector<std::uint32_t> link, parent, base, childBegin, children;  ///< kernels/link_slots.h, link_sweep.h
  std::vector<std::uint32_t> parts;  ///< first slot of each part; one more at the end
};

/// All links on device 0. An error is sticky: every later call does nothing and returns false.
class LinkSolver {
 public:
  /// Launches of a step, whatever the depth of the trees: air, up, top, down.
  static constexpr int kLaunches = 4;

  LinkSolver(const Forest& forest, std::size_t constants, std::size_t state, std::size_t windNodes);
  ~LinkSolver();
  LinkSolver(const LinkSolver&) = delete;
  LinkSolver& operator=(const LinkSolver&) = delete;

  /// New constants of all slots.
  bool setConstants(std::span<const float> constants, std::uint32_t fields);
  /// New state of all slots; `rows` are the poses at the end of the last step, the ground's and spare ones included.
  bool setState(std::span<const float> state, std::uint32_t fields, std::span<const LinkState> rows);
  /// One step in the host's wind lattice; `outside` (empty: none) are rows of loads from outside. State and poses come
  /// back to the host's arrays.
  bool step(const LinkStep<float>& parameters, const WindView& wind, std::span<const float> outside,
            std::span<float> state, std::span<LinkState> rows);
  /// The wind of the last step and the poses of the last two, in the device's memory, for leaves: rows of links alone.
  WindView windHere() const;
  LinkView linksHere(std::uint32_t links) const;
  /// Empty, or one line on what went wrong.
  const std::string& problem() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace windfall::cuda
