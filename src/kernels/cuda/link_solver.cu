#include "kernels/cuda/link_solver.h"

#include <utility>

#include "kernels/cuda/buffer.h"
#include "kernels/link_air.h"
#include "kernels/link_sweep.h"

namespace windfall::cuda {

namespace {

constexpr unsigned kAirThreads = 128;

/// A forest in the device's memory.
struct ForestView {
  LinkChildren children;
  const std::uint32_t* parts;
};

__global__ void airKernel(LinkSlots<float> slots, WindView wind, float* air, std::uint32_t count) {
  const std::uint32_t slot = blockIdx.x * blockDim.x + threadIdx.x;
  if (slot < count) slotAir(slots, wind, slot, air);
}

template <class Solver>
__device__ void upPart(const LinkSlots<float>& slots, const ForestView& forest, const LinkStep<float>& step,
                       unsigned part) {
  for (std::uint32_t first = forest.parts[part + 1]; first > forest.parts[part];) {
    first -= blockDim.x;
    slotUp<Solver>(slots, forest.children, step, first + threadIdx.x);
    __syncthreads();
  }
}

template <class Solver>
__device__ void downPart(const LinkSlots<float>& slots, const ForestView& forest, const LinkStep<float>& step,
                         unsigned part) {
  for (std::uint32_t first = forest.parts[part]; first < forest.parts[part + 1]; first += blockDim.x) {
    slotDown<Solver>(slots, step, first + threadIdx.x);
    __syncthreads();
  }
}

/// A block of threads a part.
template <class Solver>
__global__ void upKernel(LinkSlots<float> slots, ForestView forest, LinkStep<float> step) {
  upPart<Solver>(slots, forest, step, blockIdx.x + 1);
}

template <class Solver>
__global__ void topKernel(LinkSlots<float> slots, ForestView forest, LinkStep<float> step) {
  upPart<Solver>(slots, forest, step, 0);
  downPart<Solver>(slots, forest, step, 0);
}

template <class Solver>
__global__ void downKernel(LinkSlots<float> slots, ForestView forest, LinkStep<float> step) {
  downPart<Solver>(slots, forest, step, blockIdx.x + 1);
}

template <class Solver>
void launch(const LinkSlots<float>& slots, const ForestView& forest, const LinkStep<float>& step, unsigned parts,
            unsigned width) {
  if (parts > 1) upKernel<Solver><<<parts - 1, width>>>(slots, forest, step);
  topKernel<Solver><<<1, width>>>(slots, forest, step);
  if (parts > 1) downKernel<Solver><<<parts - 1, width>>>(slots, forest, step);
}

}  // namespace

std::vector<std::string> deviceNames(std::string* problem) {
  int count = 0;
  const cudaError_t error = cudaGetDeviceCount(&count);
  std::vector<std::string> names;
  if (error != cudaSuccess) {
    cudaGetLastError();  // no device is no failure of what follows
    if (problem) *problem = cudaGetErrorString(error);
    return names;
  }
  for (int i = 0; i < count; ++i) {
    cudaDeviceProp properties;
    if (cudaGetDeviceProperties(&properties, i) == cudaSuccess) names.emplace_back(properties.name);
  }
  if (names.empty() && problem) *problem = "there is no CUDA device";
  return names;
}

struct LinkSolver::Data {
  Outcome outcome;
  LinkMethod method{};
  unsigned width = 0, parts = 0;
  std::uint32_t slots = 0, constantFields = 0, stateFields = 0;
  Buffer<float> constants, state, air, sums, outside, moves;
  Buffer<LinkState> before, after;
  Buffer<vec4> wind, eddies;
  const vec4* eddySource = nullptr;  ///< on the host; what `eddies` is a copy of
  WindView here;                     ///< the wind of the last step, on the device
  Buffer<std::uint32_t> link, parent, base, childBegin, children, partStarts;
};

LinkSolver::LinkSolver(const Forest& forest, std::size_t constants, std::size_t state, std::size_t windNodes)
    : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  d.outcome.check(cudaSetDevice(0), "choice of the device");
  d.method = forest.method;
  d.width = forest.width;
  d.parts = static_cast<unsigned>(forest.parts.size()) - 1;
  d.slots = static_cast<std::uint32_t>(forest.link.size());
  d.constants.allocate(constants, d.outcome);
  d.state.allocate(state, d.outcome);
  d.air.allocate(forest.link.size() * 3, d.outcome);
  const std::size_t sums = std::size_t{forest.rows} * forest.sumRow;
  d.sums.allocate(sums, d.outcome);
  d.outside.allocate(sums, d.outcome);
  d.moves.allocate(std::size_t{forest.rows} * kMoveRow, d.outcome);
  if (d.outcome.good()) {
    // The ground hands no acceleration down.
    d.outcome.check(cudaMemset(d.moves.data(), 0, std::size_t{forest.rows} * kMoveRow * sizeof(float)), "set-up");
  }
  d.before.allocate(forest.rows, d.outcome);
  d.after.allocate(forest.rows, d.outcome);
  d.wind.allocate(windNodes, d.outcome);
  d.eddies.allocate(kTileNodes, d.outcome);
  const auto place = [&](Buffer<std::uint32_t>& buffer, const std::vector<std::uint32_t>& values) {
    buffer.allocate(values.size(), d.outcome);
    buffer.write(values, d.outcome);
  };
  place(d.link, forest.link);
  place(d.parent, forest.parent);
  place(d.base, forest.base);
  place(d.childBegin, forest.childBegin);
  place(d.children, forest.children);
  place(d.partStarts, forest.parts);
  d.outcome.check(cudaDeviceSynchronize(), "set-up");
}

LinkSolver::~LinkSolver() = default;

const std::string& LinkSolver::problem() const { return data_->outcome.problem(); }

WindView LinkSolver::windHere() const { return data_->here; }

LinkView LinkSolver::linksHere(std::uint32_t links) const { return {data_->before.data(), data_->after.data(), links}; }

bool LinkSolver::setConstants(std::span<const float> constants, std::uint32_t fields) {
  data_->constantFields = fields;
  data_->constants.write(constants, data_->outcome);
  return data_->outcome.good();
}

bool LinkSolver::setState(std::span<const float> state, std::uint32_t fields, std::span<const LinkState> rows) {
  Data& d = *data_;
  d.stateFields = fields;
  d.state.write(state, d.outcome);
  // Rows that no step writes are needed on both sides.
  d.before.write(rows, d.outcome);
  d.after.write(rows, d.outcome);
  return d.outcome.good();
}

bool LinkSolver::step(const LinkStep<float>& parameters, const WindView& wind, std::span<const float> outside,
                      std::span<float> state, std::span<LinkState> rows) {
  Data& d = *data_;
  if (!d.outcome.good()) return false;
  const auto nodes =
      static_cast<std::size_t>(wind.nx) * static_cast<std::size_t>(wind.ny) * static_cast<std::size_t>(wind.nz);
  WindView& local = d.here;
  local = wind;
  if (wind.velocity != nullptr) {
    d.wind.write({wind.velocity, nodes}, d.outcome);
    local.velocity = d.wind.data();
  }
  // The tile is the same for a whole run of the scene, but for another seed.
  if (wind.eddies != d.eddySource) {
    if (wind.eddies != nullptr) d.eddies.write({wind.eddies, kTileNodes}, d.outcome);
    d.eddySource = wind.eddies;
  }
  local.eddies = wind.eddies == nullptr ? nullptr : d.eddies.data();
  if (d.slots == 0) return d.outcome.check(cudaDeviceSynchronize(), "wind to the device");
  d.outside.write(outside, d.outcome);
  if (!d.outcome.good()) return false;
  d.before.swap(d.after);
  LinkSlots<float> slots;
  slots.link = d.link.data();
  slots.parent = d.parent.data();
  slots.base = d.base.data();
  slots.constants = d.constants.data();
  slots.state = d.state.data();
  slots.air = d.air.data();
  slots.sums = d.sums.data();
  slots.outside = outside.empty() ? nullptr : d.outside.data();
  slots.moves = d.moves.data();
  slots.before = reinterpret_cast<const float*>(d.before.data());
  slots.after = reinterpret_cast<float*>(d.after.data());
  slots.constantFields = d.constantFields;
  slots.stateFields = d.stateFields;
  const ForestView forest{{d.childBegin.data(), d.children.data()}, d.partStarts.data()};
  airKernel<<<(d.slots + kAirThreads - 1) / kAirThreads, kAirThreads>>>(slots, local, d.air.data(), d.slots);
  switch (d.method) {
    case LinkMethod::Coupled:
      launch<CoupledSolver>(slots, forest, parameters, d.parts, d.width);
      break;
    case LinkMethod::Modal:
      launch<ModalSolver>(slots, forest, parameters, d.parts, d.width);
      break;
    case LinkMethod::Axis:
      launch<AxisSolver>(slots, forest, parameters, d.parts, d.width);
      break;
    case LinkMethod::Forces:
      launch<ForcesSolver>(slots, forest, parameters, d.parts, d.width);
      break;
  }
  d.outcome.check(cudaGetLastError(), "launch of the tree solver");
  d.state.read(state, d.outcome);
  d.after.read(rows, d.outcome);
  return d.outcome.check(cudaDeviceSynchronize(), "the tree solver");
}

}  // namespace windfall::cuda
