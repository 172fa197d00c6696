// The engine on the CPU: wind, trees and leaves one after the other, OpenMP inside each.
#pragma once

#include <memory>
#include <vector>

#include "sim/engine.h"
#include "sim/leaf_field.h"
#include "sim/tree_field.h"
#include "sim/wind.h"

namespace windfall::sim {

class CpuEngine : public Engine {
 public:
  /// The scene has been checked.
  CpuEngine(SceneDescription scene, int threads, const FieldCut& cut = {});

  void step() override;
  void reset() override;
  void setWind(const WindSettings& wind) override;
  void setLeaves(const LeafSettings& leaves) override;
  void setTree(std::size_t instance, std::shared_ptr<const Tree> tree) override;
  void setPull(const std::optional<Pull>& pull) override;
  void adopt(const Engine& before, std::span<const int> from) override;
  std::size_t linkCount() const override { return trees_.size(); }
  std::size_t leafCount() const override;
  void write(std::span<mat4> boneMatrices, std::span<LeafInstance> leaves) override;
  void writePosed(std::span<const mat4> pose, std::span<mat4> boneMatrices, std::span<LeafInstance> leaves) override;
  Statistics statistics() const override;
  Timers timers() const override { return timers_; }
  DeviceInfo device() const override;
  std::string deviceProblem() const override { return {}; }
  double time() const override;
  std::vector<std::uint8_t> save() const override;
  Status restore(std::span<const std::uint8_t> bytes) override;
  std::uint64_t hash() const override;
  WindView windView() const override { return wind_.view(); }

 protected:
  double stepLength() const override { return static_cast<double>(scene_.solver.step); }
  /// One step of all links in the current wind.
  virtual void moveTrees(TreeField& trees, const WindView& wind);
  const TreeField& trees() const { return trees_; }
  LeafField& leaves() { return leaves_; }

 private:
  FactorSettings factorSettings() const;
  void followWind();
  void takeWind();
  void followLeaves();
  void forgetLeaves();
  void poseWhereMoved();
  LinkView linkView() const;
  std::uint64_t fingerprint() const;

  SceneDescription scene_;
  int threads_;
  WindField wind_;
  TreeField trees_;
  LeafField leaves_;
  std::vector<float> lostArea_;      ///< of each link's leaves by now, m2; the trees know it with a delay
  double leafArea_ = 0;              ///< of all links, m2
  std::vector<vec4> restRotations_;  ///< inverse rest pose of each link: tree space
  std::vector<vec3> restPositions_;
  std::int64_t steps_ = 0;
  std::size_t tipLink_ = 0;
  vec3 tipRest_{0};  ///< world
  Timers timers_;
  PullForce pull_;
};

}  // namespace windfall::sim
