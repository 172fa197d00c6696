#include "widgets/viewport/detail_bench_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "kernels/detail_select.h"
#include "model/plant/bark.h"
#include "model/plant/detail_mesh.h"
#include "widgets/viewport/scene_content.h"

namespace windfall::widgets {

namespace {

constexpr float kTau = 6.28318531f;
constexpr int kColumns = 10;
constexpr float kApart = 1.2f;  // m

struct Counts {
  std::uint32_t sides = 16, pieces = 8;
};

/// The same bark on all three meshes.
void addBark(render::Mesh& mesh) {
  const model::Material bark = model::barkMaterial(model::BarkKind::Oak);
  mesh.pictures.push_back(toPicture(bark.texture));
  mesh.materials.push_back({bark.baseColor, 0, bark.roughness, false});
  mesh.parts.push_back({0, static_cast<std::uint32_t>(mesh.indices.size()), 0, true});
}

/// A tube for each span, with the counts that `countsOf` gives it.
template <class CountsOf>
render::Mesh tubes(const std::vector<model::ChainCurve>& curves, const model::RingSet& bare, bool outline,
                   const CountsOf& countsOf) {
  render::Mesh mesh;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const model::Ring* rings = bare.rings.data() + bare.chains[c].first;
    for (std::size_t s = 0; s < curves[c].spans.size(); ++s) {
      const model::CurveSpan& span = curves[c].spans[s];
      const Counts counts = countsOf(span);
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      const model::Ring &from = rings[s], &to = rings[s + 1];
      for (std::uint32_t i = 0; i <= counts.pieces; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(counts.pieces);
        const vec3 tangent = span.tangent(t), point = span.point(t);
        vec3 normal = glm::mix(from.normal, to.normal, t);
        normal = glm::normalize(normal - tangent * glm::dot(normal, tangent));
        const vec3 side = glm::cross(tangent, normal);
        const float factor = outline ? detail::outlineFactor(static_cast<float>(counts.sides)) : 1;
        const float radius = std::max(span.radius(t), 1e-5f) * factor;
        for (std::uint32_t j = 0; j <= counts.sides; ++j) {
          const float share = static_cast<float>(j % counts.sides) / static_cast<float>(counts.sides);
          render::Vertex vertex;
          vertex.normal = normal * std::cos(kTau * share) + side * std::sin(kTau * share);
          vertex.position = point + vertex.normal * radius;
          vertex.uv = vec2(static_cast<float>(j) / static_cast<float>(counts.sides), glm::mix(from.v, to.v, t));
          vertex.links[0] = static_cast<std::uint32_t>(std::max(from.segment, 0));
          vertex.links[1] = static_cast<std::uint32_t>(std::max(to.segment, 0));
          vertex.weights[0] = 1 - t;
          vertex.weights[1] = t;
          mesh.vertices.push_back(vertex);
        }
      }
      const std::uint32_t row = counts.sides + 1;
      for (std::uint32_t i = 0; i < counts.pieces; ++i) {
        for (std::uint32_t j = 0; j < counts.sides; ++j) {
          const std::uint32_t a = first + i * row + j, b = a + row;
          for (const std::uint32_t index : {a, a + 1, b, a + 1, b + 1, b}) mesh.indices.push_back(index);
        }
      }
    }
  }
  addBark(mesh);
  return mesh;
}

}  // namespace

BenchPlant makeBenchPlant(model::SkeletonGraph graph, float tolerance) {
  BenchPlant plant;
  const model::Chains chains = findChains(graph);
  const auto curves = makeCurves(graph, chains, model::CurveKind::Hermite);
  model::RingSettings naked;
  naked.collars = false;
  naked.flare = 0;
  const model::RingSet bare = makeRings(graph, chains, curves, naked);
  plant.uniform = tubes(curves, bare, false, [](const model::CurveSpan&) { return Counts{16, 8}; });
  plant.bounded = tubes(curves, bare, true, [&](const model::CurveSpan& span) {
    const float radius = std::max(span.r0, span.r1);
    const float share = std::clamp(1 - tolerance / std::max(radius, 1e-6f), -1.0f, 1.0f);
    const float sides = std::clamp(std::ceil(3.14159265f / std::acos(share)), 3.0f, 48.0f);
    const vec3 t0 = span.tangent(0), t1 = span.tangent(1);
    const float angle = std::atan2(glm::length(glm::cross(t0, t1)), glm::dot(t0, t1));
    const float sag = glm::length(span.p1 - span.p0) * angle / 8;
    const float pieces = std::clamp(std::ceil(std::sqrt(sag / tolerance)), 1.0f, 8.0f);
    return Counts{static_cast<std::uint32_t>(sides), static_cast<std::uint32_t>(pieces)};
  });
  // Seats, collars and tips as in the program; a foot that the others do not have would tell them apart.
  model::RingSettings full;
  full.flare = 0;
  plant.adaptive =
      std::make_shared<DetailMesh>(makeDetail(graph, chains, curves, makeRings(graph, chains, curves, full), {}));
  plant.graph = std::move(graph);
  return plant;
}

vec3 BenchScene::place(int tree) {
  const auto column = static_cast<float>(tree % kColumns), row = static_cast<float>(tree / kColumns);
  return {(column - 0.5f * (kColumns - 1)) * kApart, 0, -row * kApart};
}

render::SceneContent BenchScene::content(BenchMesh mesh) const {
  render::SceneContent content;
  for (const BenchPlant& plant : plants) {
    if (mesh == BenchMesh::Adaptive) {
      addBark(content.meshes.emplace_back());
      content.details.push_back(plant.adaptive);
    } else {
      content.meshes.push_back(mesh == BenchMesh::Uniform ? plant.uniform : plant.bounded);
    }
  }
  for (int i = 0; i < trees; ++i) {
    const auto plant = static_cast<std::size_t>(i) % plants.size();
    const auto links = static_cast<std::uint32_t>(plants[plant].graph.segments.size());
    content.trees.push_back({static_cast<int>(plant), static_cast<std::uint32_t>(content.linkCount), links,
                             mesh == BenchMesh::Adaptive ? static_cast<int>(plant) : -1});
    content.linkCount += links;
  }
  return content;
}

std::vector<mat4> BenchScene::pose(float time) const {
  std::vector<mat4> bones;
  for (int i = 0; i < trees; ++i) {
    const auto phase = static_cast<float>(i);
    const mat4 root = glm::rotate(glm::translate(mat4(1), place(i)), 2.4f * phase, vec3(0, 1, 0));
    for (const model::Segment& segment : plants[static_cast<std::size_t>(i) % plants.size()].graph.segments) {
      const float height = segment.b.y, sway = 0.12f * height * height * std::sin(1.7f * time + 0.9f * phase);
      bones.push_back(glm::rotate(root, sway, vec3(0, 0, 1)));
    }
  }
  return bones;
}

}  // namespace windfall::widgets
