#include "kernels/cuda/link_solver.h"

#include <utility>

#include "kernels/cuda/buffer.h"
#include "kernels/link_treelet.h"

namespace windfall::cuda {

namespace {

constexpr unsigned kBlock = 128;

struct Meet {
  __device__ void operator()() const { __syncthreads(); }
};

__global__ void forcesKernel(LinksView links, WindView wind, std::uint32_t count) {
  const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i < count) linkForces(links, wind, i);
}

/// A block a treelet; part 0 is the top.
__global__ void upKernel(LinksView links, ForestView forest, LinkStepParameters step) {
  sweepUp(links, forest, step, blockIdx.x + 1, threadIdx.x, blockDim.x, Meet{});
}

__global__ void topKernel(LinksView links, ForestView forest, LinkStepParameters step) {
  sweepUp(links, forest, step, 0, threadIdx.x, blockDim.x, Meet{});
  sweepDown(links, forest, step, 0, threadIdx.x, blockDim.x, Meet{});
}

__global__ void downKernel(LinksView links, ForestView forest, LinkStepParameters step) {
  sweepDown(links, forest, step, blockIdx.x + 1, threadIdx.x, blockDim.x, Meet{});
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
  std::size_t links = 0, treelets = 0;
  Buffer<LinkShape> shapes;
  Buffer<LinkFactor> factors;
  Buffer<LinkMotion> motion;
  Buffer<LinkLoad> loads, exports;
  Buffer<LinkState> before, after;
  Buffer<vec4> wind, eddies;
  const vec4* eddySource = nullptr;  ///< on the host; what `eddies` is a copy of
  Buffer<std::uint32_t> order, levels, parts, children, childBegin;
};

LinkSolver::LinkSolver(const Forest& forest, std::size_t links, std::size_t windNodes)
    : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  d.outcome.check(cudaSetDevice(0), "choice of the device");
  d.links = links;
  d.treelets = forest.parts.size() - 2;
  d.shapes.allocate(links, d.outcome);
  d.factors.allocate(links, d.outcome);
  d.motion.allocate(links, d.outcome);
  d.loads.allocate(links, d.outcome);
  d.exports.allocate(links, d.outcome);
  d.before.allocate(links, d.outcome);
  d.after.allocate(links, d.outcome);
  d.wind.allocate(windNodes, d.outcome);
  d.eddies.allocate(kTileNodes, d.outcome);
  const auto place = [&](Buffer<std::uint32_t>& buffer, const std::vector<std::uint32_t>& values) {
    buffer.allocate(values.size(), d.outcome);
    buffer.write(values, d.outcome);
  };
  place(d.order, forest.order);
  place(d.levels, forest.levels);
  place(d.parts, forest.parts);
  place(d.children, forest.children);
  place(d.childBegin, forest.childBegin);
  d.outcome.check(cudaDeviceSynchronize(), "set-up");
}

LinkSolver::~LinkSolver() = default;

const std::string& LinkSolver::problem() const { return data_->outcome.problem(); }

bool LinkSolver::setConstants(std::span<const LinkShape> shapes, std::span<const LinkFactor> factors) {
  data_->shapes.write(shapes, data_->outcome);
  data_->factors.write(factors, data_->outcome);
  return data_->outcome.good();
}

bool LinkSolver::setState(std::span<const LinkMotion> motion, std::span<const LinkState> now) {
  data_->motion.write(motion, data_->outcome);
  data_->after.write(now, data_->outcome);
  return data_->outcome.good();
}

bool LinkSolver::step(const LinkStepParameters& parameters, const WindView& wind, std::span<LinkMotion> motion,
                      std::span<LinkState> now) {
  Data& d = *data_;
  if (!d.outcome.good() || d.links == 0) return d.outcome.good();
  const auto nodes =
      static_cast<std::size_t>(wind.nx) * static_cast<std::size_t>(wind.ny) * static_cast<std::size_t>(wind.nz);
  d.wind.write({wind.velocity, nodes}, d.outcome);
  if (!d.outcome.good()) return false;
  d.before.swap(d.after);
  const LinksView links{d.shapes.data(), d.factors.data(), d.motion.data(),
                        d.loads.data(),  d.before.data(),  d.after.data()};
  const ForestView forest{d.order.data(),    d.levels.data(),     d.parts.data(),
                          d.children.data(), d.childBegin.data(), d.exports.data()};
  WindView local = wind;
  local.velocity = d.wind.data();
  // The tile is the same for a whole run of the scene, but for another seed.
  if (wind.eddies != d.eddySource) {
    if (wind.eddies != nullptr) d.eddies.write({wind.eddies, kTileNodes}, d.outcome);
    d.eddySource = wind.eddies;
  }
  local.eddies = wind.eddies == nullptr ? nullptr : d.eddies.data();
  const auto count = static_cast<std::uint32_t>(d.links);
  forcesKernel<<<(count + kBlock - 1) / kBlock, kBlock>>>(links, local, count);
  if (d.treelets > 0) upKernel<<<static_cast<unsigned>(d.treelets), kBlock>>>(links, forest, parameters);
  topKernel<<<1, kBlock>>>(links, forest, parameters);
  if (d.treelets > 0) downKernel<<<static_cast<unsigned>(d.treelets), kBlock>>>(links, forest, parameters);
  d.outcome.check(cudaGetLastError(), "launch of the tree solver");
  d.motion.read(motion, d.outcome);
  d.after.read(now, d.outcome);
  return d.outcome.check(cudaDeviceSynchronize(), "the tree solver");
}

}  // namespace windfall::cuda
