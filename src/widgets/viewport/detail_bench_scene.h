// The plants of the flight: three meshes of each, and how they sway.
#pragma once

#include <vector>

#include "model/plant/rings.h"
#include "widgets/render/content.h"

namespace windfall::widgets {

/// Chains and curves of a skeleton, with what is made of them.
struct BenchPlant {
  model::SkeletonGraph graph;
  render::Mesh uniform, bounded;
  std::shared_ptr<const DetailMesh> adaptive;
};

/// `tolerance` in m is that of the bounded mesh.
BenchPlant makeBenchPlant(model::SkeletonGraph graph, float tolerance);

enum class BenchMesh { Uniform, Bounded, Adaptive };

/// Trees in rows, 1.2 m apart; tree i shows plant i modulo their number.
struct BenchScene {
  std::vector<BenchPlant> plants;
  int trees = 50;

  render::SceneContent content(BenchMesh mesh) const;
  /// Matrices of all links, swaying, at a time in s.
  std::vector<mat4> pose(float time) const;
  static vec3 place(int tree);
};

}  // namespace windfall::widgets
