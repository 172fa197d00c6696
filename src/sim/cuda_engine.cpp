#include "sim/cuda_engine.h"

#include "kernels/cuda/link_solver.h"
#include "sim/cpu_engine.h"

namespace windfall::sim {

#if defined(WINDFALL_CUDA)

namespace {

std::vector<std::int32_t> parentsOf(const TreeField& trees) {
  std::vector<std::int32_t> parents;
  for (const LinkShape& shape : trees.shapes()) parents.push_back(shape.parent);
  return parents;
}

std::size_t nodesOf(const WindView& wind) {
  return static_cast<std::size_t>(wind.nx) * static_cast<std::size_t>(wind.ny) * static_cast<std::size_t>(wind.nz);
}

/// The state comes back to the host after each step: leaves and statistics need it there, and when the device fails the
/// scene goes on from it.
class CudaEngine final : public CpuEngine {
 public:
  CudaEngine(const SceneDescription& scene, int threads, std::string name)
      : CpuEngine(scene, threads),
        name_(std::move(name)),
        solver_(forestOf(trees().cut(), parentsOf(trees())), trees().size(), nodesOf(windView())),
        motion_(trees().size()),
        now_(trees().size()) {}

  DeviceInfo device() const override {
    return solver_.problem().empty() ? DeviceInfo{Device::Cuda, name_} : CpuEngine::device();
  }
  std::string deviceProblem() const override { return solver_.problem(); }

 protected:
  void moveTrees(TreeField& trees, const WindView& wind) override {
    if (solver_.problem().empty() && revision_ != trees.revision()) {
      solver_.setConstants(trees.shapes(), trees.factors());
      solver_.setState(trees.motion(), trees.current());
      revision_ = trees.revision();
    }
    const FactorSettings& settings = trees.settings();
    const LinkStepParameters parameters{static_cast<float>(settings.h), static_cast<float>(settings.implicitness)};
    if (solver_.step(parameters, wind, motion_, now_)) {
      trees.takeStep(motion_, now_);
    } else {
      trees.step(wind);
    }
  }

 private:
  std::string name_;
  cuda::LinkSolver solver_;
  std::vector<LinkMotion> motion_;
  std::vector<LinkState> now_;
  std::uint64_t revision_ = 0;  // of the trees, as the device has them; theirs starts above 0
};

}  // namespace

std::string cudaDeviceName() {
  const std::vector<std::string> names = cuda::deviceNames();
  return names.empty() ? std::string() : names.front();
}

std::unique_ptr<Engine> makeCudaEngine(const SceneDescription& scene, int threads, std::string& problem) {
  const std::vector<std::string> names = cuda::deviceNames(&problem);
  if (names.empty()) return nullptr;
  auto engine = std::make_unique<CudaEngine>(scene, threads, names.front());
  problem = engine->deviceProblem();
  if (!problem.empty()) return nullptr;
  return engine;
}

#else

std::string cudaDeviceName() { return {}; }

std::unique_ptr<Engine> makeCudaEngine(const SceneDescription&, int, std::string& problem) {
  problem = "this program was built without CUDA";
  return nullptr;
}

#endif

}  // namespace windfall::sim
