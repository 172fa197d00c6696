#include "sim/cuda_engine.h"

#include "kernels/cuda/link_solver.h"
#include "sim/cpu_engine.h"

namespace windfall::sim {

#if defined(WINDFALL_CUDA)

namespace {

std::size_t nodesOf(const WindView& wind) {
  return static_cast<std::size_t>(wind.nx) * static_cast<std::size_t>(wind.ny) * static_cast<std::size_t>(wind.nz);
}

constexpr FieldCut kCut{512, 1024, 128};

cuda::LinkMethod methodOf(const FactorSettings& settings) {
  if (settings.method == TreeMethod::Coupled) return cuda::LinkMethod::Coupled;
  if (settings.method == TreeMethod::Forces) return cuda::LinkMethod::Forces;
  return usesAxes(settings) ? cuda::LinkMethod::Axis : cuda::LinkMethod::Modal;
}

cuda::Forest forestOf(const TreeField& trees) {
  const Arrangement& slots = trees.slots();
  cuda::Forest forest;
  forest.method = methodOf(trees.settings());
  forest.width = kCut.width;
  forest.rows = slots.rows;
  forest.sumRow = trees.sumRow();
  forest.link = slots.link;
  forest.parent = slots.parent;
  forest.base.assign(trees.bases().begin(), trees.bases().end());
  Gathering gathering = gatheringOf(slots, trees.parents());
  forest.childBegin = std::move(gathering.begin);
  forest.children = std::move(gathering.rows);
  for (const Part& part : slots.parts) forest.parts.push_back(part.begin * kSlotBlock);
  forest.parts.push_back(static_cast<std::uint32_t>(slots.link.size()));
  return forest;
}

/// The state comes back to the host after each step: leaves and statistics need it there, and when the device fails the
/// scene goes on from it.
class CudaEngine final : public CpuEngine {
 public:
  CudaEngine(const SceneDescription& scene, int threads, std::string name)
      : CpuEngine(scene, threads, kCut),
        name_(std::move(name)),
        solver_(forestOf(trees()), trees().constants().size(), trees().slotState().size(), nodesOf(windView())),
        state_(trees().slotState().size()),
        now_(trees().rows().size()) {}

  DeviceInfo device() const override {
    return solver_.problem().empty() ? DeviceInfo{Device::Cuda, name_} : CpuEngine::device();
  }
  std::string deviceProblem() const override { return solver_.problem(); }

 protected:
  void moveTrees(TreeField& trees, const WindView& wind) override {
    if (solver_.problem().empty() && revision_ != trees.revision()) {
      const LinkSlots<float> view = trees.view();
      solver_.setConstants(trees.constants(), view.constantFields);
      solver_.setState(trees.slotState(), view.stateFields, trees.rows());
      revision_ = trees.revision();
    }
    trees.follow(wind.pull);
    if (solver_.step(trees.stepParameters(), wind, trees.outside(), state_, now_)) {
      trees.takeStep(state_, now_);
    } else {
      CpuEngine::moveTrees(trees, wind);
    }
  }

 private:
  std::string name_;
  cuda::LinkSolver solver_;
  AlignedVector<float> state_;
  AlignedVector<LinkState> now_;
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
