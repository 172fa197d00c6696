#include "sim/cuda_engine.h"

#include <functional>

#include "kernels/cuda/leaf_solver.h"
#include "kernels/cuda/link_solver.h"
#include "sim/cpu_engine.h"
#include "sim/leaf_storage.h"

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

/// The leaves beside the links in the device's memory; nothing crosses the bus in a step.
class CudaLeaves final : public LeafDevice {
 public:
  /// `areCurrent`: whether poses of the host are those on the device.
  CudaLeaves(const LeafStorage& storage, const cuda::LinkSolver& links, std::function<bool(const LinkView&)> areCurrent,
             std::string& problem)
      : links_(links),
        areCurrent_(std::move(areCurrent)),
        problem_(problem),
        solver_(storage.arrays, storage.block(), leafBlockBytes(storage.arrays.count, storage.links), storage.links) {}

  bool upload(const LeafArrays& host, const std::byte* block) override { return told(solver_.upload(host, block)); }
  bool download(std::byte* block) override { return told(solver_.download(block)); }
  bool step(const LeafStep& host) override {
    if (!links_.problem().empty() || !areCurrent_(host.links)) return false;
    LeafStep step = host;
    step.links = links_.linksHere(host.links.count);
    step.wind = links_.windHere();
    return told(solver_.step(step));
  }
  bool write(const LeafDisplay& host, std::span<LeafInstance> leaves) override {
    LeafDisplay display = host;
    // Poses of a clip, or of a tree that was just set back, are the host's alone.
    const bool here = links_.problem().empty() && areCurrent_(host.links);
    if (here) display.links = links_.linksHere(host.links.count);
    return told(solver_.write(display, here, leaves));
  }
  bool counts(LeafTotals& totals, std::span<std::int32_t> lost) override { return told(solver_.counts(totals, lost)); }

 private:
  bool told(bool good) {
    if (!good) problem_ = solver_.problem();
    return good;
  }

  const cuda::LinkSolver& links_;
  std::function<bool(const LinkView&)> areCurrent_;
  std::string& problem_;  ///< of the engine: where this says what went wrong
  cuda::LeafSolver solver_;
};

/// The trees' state comes back to the host after each step: the display and statistics need it there, and when the
/// device fails the scene goes on from it. The leaves stay on the device until they are asked for.
class CudaEngine final : public CpuEngine {
 public:
  CudaEngine(const SceneDescription& scene, int threads, std::string name)
      : CpuEngine(scene, threads, kCut),
        name_(std::move(name)),
        solver_(forestOf(trees()), trees().constants().size(), trees().slotState().size(), nodesOf(windView())),
        state_(trees().slotState().size()),
        now_(trees().rows().size()) {
    leaves().useDevice([this](const LeafStorage& storage) {
      const auto current = [this](const LinkView& host) {
        return revision_ == trees().revision() && host.current == trees().current().data();
      };
      return std::make_unique<CudaLeaves>(storage, solver_, current, leafProblem_);
    });
  }

  DeviceInfo device() const override {
    return solver_.problem().empty() ? DeviceInfo{Device::Cuda, name_} : CpuEngine::device();
  }
  std::string deviceProblem() const override { return solver_.problem().empty() ? leafProblem_ : solver_.problem(); }

 protected:
  void moveTrees(TreeField& trees, const WindView& wind) override {
    if (solver_.problem().empty()) trees.renewOn();
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
  std::string name_, leafProblem_;
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
