#include "kernels/cuda/leaf_solver.h"

#include <utility>

#include "kernels/cuda/buffer.h"
#include "kernels/leaf_range.h"
#include "kernels/leaf_step.h"

namespace windfall::cuda {

namespace {

constexpr unsigned kThreads = 128;

__global__ void stepKernel(LeafArrays leaves, LeafStep step) {
  const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i < leaves.count) stepLeaf(leaves, i, step, kLeafBlock);
}

__global__ void showKernel(LeafArrays leaves, LeafDisplay display, LeafInstance* out, std::uint32_t count) {
  const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i < count) out[i] = showLeaf(leaves, i, display);
}

unsigned blocksFor(std::uint32_t count) { return (count + kThreads - 1) / kThreads; }

}  // namespace

struct LeafSolver::Data {
  Outcome outcome;
  LeafArrays arrays{};  ///< pointers into `block`
  std::uint32_t links = 0;
  Buffer<std::byte> block;
  Buffer<LinkState> before, after;
  Buffer<LeafInstance> instances;
  std::size_t bytes = 0;

  LinkView linksFrom(const LinkView& host) {
    before.write({host.previous, host.count}, outcome);
    after.write({host.current, host.count}, outcome);
    return {before.data(), after.data(), host.count};
  }
};

LeafSolver::LeafSolver(const LeafArrays& host, const std::byte* block, std::size_t bytes, std::size_t links)
    : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  d.outcome.check(cudaSetDevice(0), "choice of the device");
  d.bytes = bytes;
  d.links = static_cast<std::uint32_t>(links);
  d.block.allocate(bytes, d.outcome);
  d.before.allocate(links, d.outcome);
  d.after.allocate(links, d.outcome);
  d.instances.allocate(host.count, d.outcome);
  upload(host, block);
}

LeafSolver::~LeafSolver() = default;

const std::string& LeafSolver::problem() const { return data_->outcome.problem(); }

bool LeafSolver::upload(const LeafArrays& host, const std::byte* block) {
  Data& d = *data_;
  d.block.write({block, d.bytes}, d.outcome);
  if (!d.outcome.good()) return false;
  // The same offsets in the device's block, whichever side is the new one now.
  d.arrays = host;
  visitArrays(d.arrays, d.links, [&](auto*& pointer, std::uint32_t, bool) {
    const std::ptrdiff_t offset = reinterpret_cast<const std::byte*>(pointer) - block;
    pointer = reinterpret_cast<std::remove_reference_t<decltype(pointer)>>(d.block.data() + offset);
  });
  return d.outcome.check(cudaDeviceSynchronize(), "leaves to the device");
}

bool LeafSolver::download(std::byte* block) const {
  data_->block.read({block, data_->bytes}, data_->outcome);
  return data_->outcome.good() && data_->outcome.check(cudaDeviceSynchronize(), "leaves from the device");
}

bool LeafSolver::step(const LeafStep& step) {
  Data& d = *data_;
  if (!d.outcome.good() || d.arrays.count == 0) return d.outcome.good();
  stepKernel<<<blocksFor(d.arrays.count), kThreads>>>(d.arrays, step);
  std::swap(d.arrays.x, d.arrays.nextX);
  std::swap(d.arrays.y, d.arrays.nextY);
  std::swap(d.arrays.z, d.arrays.nextZ);
  std::swap(d.arrays.turn, d.arrays.nextTurn);
  return d.outcome.check(cudaGetLastError(), "launch of the leaves' step");
}

bool LeafSolver::write(const LeafDisplay& host, bool linksAreHere, std::span<LeafInstance> leaves) {
  Data& d = *data_;
  const auto count = static_cast<std::uint32_t>(leaves.size() < d.arrays.count ? leaves.size() : d.arrays.count);
  if (!d.outcome.good() || count == 0) return d.outcome.good();
  LeafDisplay display = host;
  if (!linksAreHere) display.links = d.linksFrom(host.links);
  if (!d.outcome.good()) return false;
  showKernel<<<blocksFor(count), kThreads>>>(d.arrays, display, d.instances.data(), count);
  d.outcome.check(cudaGetLastError(), "launch of the leaves' display");
  d.instances.read(leaves.first(count), d.outcome);
  return d.outcome.check(cudaDeviceSynchronize(), "leaves for the display");
}

bool LeafSolver::counts(LeafTotals& totals, std::span<std::int32_t> lost) const {
  Data& d = *data_;
  if (!d.outcome.good() || lost.size() > d.links) return false;
  const std::size_t bytes = lost.size_bytes();
  if (bytes > 0 && !d.outcome.check(cudaMemcpyAsync(lost.data(), d.arrays.lost, bytes, cudaMemcpyDeviceToHost),
                                    "what the links have lost")) {
    return false;
  }
  return d.outcome.check(cudaMemcpy(&totals, d.arrays.totals, sizeof(totals), cudaMemcpyDeviceToHost),
                         "totals of the leaves");
}

}  // namespace windfall::cuda
