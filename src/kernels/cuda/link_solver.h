// The tree solver on a CUDA device, seen from C++ that knows no CUDA.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "kernels/link_data.h"
#include "kernels/wind.h"

namespace windfall::cuda {

/// Names of the usable devices; empty where there is none. `problem` says why, in one line.
std::vector<std::string> deviceNames(std::string* problem = nullptr);

/// The arrays of a ForestView on the host. Part 0 holds the links above all treelets.
struct Forest {
  std::vector<std::uint32_t> order, levels, parts, children, childBegin;
};

/// All links on device 0. An error is sticky: every later call does nothing and returns false.
class LinkSolver {
 public:
  LinkSolver(const Forest& forest, std::size_t links, std::size_t windNodes);
  ~LinkSolver();
  LinkSolver(const LinkSolver&) = delete;
  LinkSolver& operator=(const LinkSolver&) = delete;

  /// New constants of all links.
  bool setConstants(std::span<const LinkShape> shapes, std::span<const LinkFactor> factors);
  /// New state of all links; `now` is the pose at the end of the last step.
  bool setState(std::span<const LinkMotion> motion, std::span<const LinkState> now);
  /// One step in the host's wind lattice, in four launches whatever the depth of the trees; the state comes back to the
  /// host's arrays.
  bool step(const LinkStepParameters& parameters, const WindView& wind, std::span<LinkMotion> motion,
            std::span<LinkState> now);
  /// Empty, or one line on what went wrong.
  const std::string& problem() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace windfall::cuda
