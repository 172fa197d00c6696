// A tree with a crown of leaves, for the tests of cards: links, sites, what the renderer draws of them, and how much
// of a picture that covers.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <string>

#include "kernels/leaf_look.h"
#include "kernels/random.h"
#include "sim/engine.h"
#include "sim/leaf_sites.h"
#include "support/render_stage.h"
#include "widgets/render/gl_object.h"
#include "widgets/render/shader_program.h"

namespace windfall::test {

inline constexpr float kCrownLeaf = 0.06f;   // m
inline constexpr float kNearPlane = 0.05f;   // m, as in frame_uniforms.cpp: depth is near / distance
inline constexpr float kCrownHeight = 1500;  // m: the ground is far behind it from every side

/// Limbs in all directions from a trunk's top, and twigs on them with leaves of some order: more lie flat than stand.
struct LeafyCrown {
  std::shared_ptr<sim::Tree> tree = std::make_shared<sim::Tree>();
  std::uint64_t seed = 4;
  std::size_t leafCount = 0;
  std::vector<sim::LeafPlace> places;

  explicit LeafyCrown(int limbs = 14, int leavesATwig = 24, vec3 foot = vec3(0)) {
    RandomSequence random(11);
    const auto draw = [&] { return static_cast<float>(random.uniform(-1, 1)); };
    const auto add = [&](std::int32_t parent, vec3 from, vec3 to) {
      sim::Link link;
      link.parent = parent;
      link.joint = from;
      const vec3 along = glm::normalize(to - from);
      const vec3 axis = glm::cross(vec3(0, 0, 1), along);
      const float angle = std::atan2(glm::length(axis), along.z);
      link.rotation = glm::length(axis) > 1e-4f ? glm::angleAxis(angle, glm::normalize(axis)) : quat(1, 0, 0, 0);
      link.length = glm::distance(from, to);
      link.radius = 0.01f;
      tree->links.push_back(link);
      return static_cast<std::int32_t>(tree->links.size()) - 1;
    };
    const std::int32_t trunk = add(-1, foot, foot + vec3(0, 1, 0));
    for (int l = 0; l < limbs; ++l) {
      vec3 out(draw(), draw(), draw());
      while (glm::length(out) > 1 || glm::length(out) < 0.2f) out = {draw(), draw(), draw()};
      out = glm::normalize(out);
      const vec3 base = foot + vec3(0, 1.6f, 0), tip = base + 1.5f * out;
      const std::int32_t limb = add(trunk, base, tip);
      for (int t = 0; t < 9; ++t) {
        const vec3 from = glm::mix(base, tip, 0.25f + 0.09f * static_cast<float>(t));
        const std::int32_t twig = add(limb, from, from + 0.45f * glm::normalize(out + vec3(draw(), draw(), draw())));
        for (int i = 0; i < leavesATwig; ++i) {
          sim::LeafSite site;
          site.link = twig;
          site.position =
              vec3(0.12f * draw(), 0.12f * draw(), 0.45f * static_cast<float>(i) / static_cast<float>(leavesATwig));
          const quat world = glm::angleAxis(3 * draw(), vec3(0, 1, 0)) *
                             glm::angleAxis(-1.57f + 0.7f * draw(), vec3(1, 0, 0)) *
                             glm::angleAxis(0.5f * draw(), vec3(0, 1, 0));
          site.rotation = glm::conjugate(tree->links[static_cast<std::size_t>(twig)].rotation) * world;
          site.size = kCrownLeaf * (1 + 0.2f * draw());
          tree->sites.push_back(site);
        }
      }
    }
    leafCount = tree->sites.size();
    places = sim::chooseSites({{tree, {}}}, static_cast<std::uint32_t>(leafCount), seed);
  }

  render::SceneContent content(const render::LeafLayer& layer) const {
    render::SceneContent content;
    // No wood to be seen, but the crown's size.
    render::Mesh mesh;
    for (const float side : {-1.0f, 1.0f, -1.0f}) {
      render::Vertex corner;
      corner.position = tree->links.front().joint + vec3(0, 1.6f, 0) + 1.9f * vec3(side);
      corner.normal = vec3(0, 1, 0);
      corner.weights[0] = 1;
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
      mesh.vertices.push_back(corner);
    }
    mesh.materials.emplace_back();
    mesh.parts.push_back({0, 3, 0});
    content.meshes.push_back(mesh);
    const auto links = static_cast<std::uint32_t>(tree->links.size());
    content.trees.push_back({0, 0, links});
    content.linkCount = links;
    content.leafTrees.push_back(tree);
    content.leafCount = leafCount;
    content.leafSeed = seed;
    content.leafLayers.push_back(layer);
    return content;
  }

  /// At rest, so high that no ground is seen beside it.
  std::vector<mat4> standing() const {
    return std::vector<mat4>(tree->links.size(), glm::translate(mat4(1), vec3(0, kCrownHeight, 0)));
  }

  /// Each link moved by its matrix; leaves that `gone` says are hidden.
  template <class Gone>
  void write(const render::FrameSlot& slot, const std::vector<mat4>& moved, const Gone& gone, float season = 0) const {
    std::copy(moved.begin(), moved.end(), slot.bones.begin());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const sim::LeafSite& site = places[i].site;
      const sim::Link& link = tree->links[static_cast<std::size_t>(site.link)];
      const mat4& matrix = moved[static_cast<std::size_t>(site.link)];
      const std::uint32_t look = hash(seed, static_cast<std::uint32_t>(i));
      const quat turn = glm::normalize(glm::quat_cast(mat3(matrix)) * link.rotation * site.rotation);
      LeafInstance leaf{};
      leaf.position = vec3(matrix * vec4(link.joint + link.rotation * site.position, 1));
      leaf.size = site.size;
      leaf.rotation = {turn.x, turn.y, turn.z, turn.w};
      leaf.state = static_cast<std::uint32_t>(gone(i) ? LeafState::Hidden : LeafState::Attached);
      leaf.curl = leafCurl(leafOwn(look), season);
      leaf.tint = leafTint(look);
      slot.leaves[i] = leaf;
    }
  }
};

/// Equal within a share of the value.
inline doctest::Approx within(double value, double share) { return doctest::Approx(value).scale(0).epsilon(share); }

/// Counts the samples of the last picture that something nearer than `within` m covers, with where they are.
struct CoveredSamples {
  double share = 0;
  vec2 middle{0};  ///< of what is covered, 0..1
};

inline CoveredSamples coveredSamples(const render::Renderer& renderer, int width, int height, float within) {
  static const char* const kSource = R"(
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2DMS depth;
layout(location = 0) uniform float least;
layout(std430, binding = 15) buffer Counts { uint counts[]; };
void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, textureSize(depth)))) return;
  uint found = 0u;
  for (int i = 0; i < 4; ++i) found += texelFetch(depth, at, i).r > least ? 1u : 0u;
  atomicAdd(counts[at.y], found);
  atomicAdd(counts[textureSize(depth).y + at.x], found);
}
)";
  auto shader = render::compileShader(GL_COMPUTE_SHADER, "covered", kSource, {});
  REQUIRE_MESSAGE(bool(shader), shader.error().message);
  const render::Program program(glCreateProgram());
  glAttachShader(program.id(), shader->id());
  glLinkProgram(program.id());
  const std::vector<GLuint> zeros(static_cast<std::size_t>(width + height), 0u);
  std::vector<GLuint> counts(zeros.size());
  const auto bytes = static_cast<GLsizeiptr>(zeros.size() * sizeof(GLuint));
  const render::Buffer buffer = render::makeBuffer(bytes, zeros.data(), 0);
  glUseProgram(program.id());
  glUniform1f(0, kNearPlane / within);
  glBindTextureUnit(0, renderer.depth());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 15, buffer.id());
  glDispatchCompute(static_cast<GLuint>(width + 7) / 8, static_cast<GLuint>(height + 7) / 8, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(buffer.id(), 0, bytes, counts.data());
  double all = 0, sumX = 0, sumY = 0;
  for (int y = 0; y < height; ++y)
    all += counts[static_cast<std::size_t>(y)], sumY += (y + 0.5) * counts[static_cast<std::size_t>(y)];
  for (int x = 0; x < width; ++x) sumX += (x + 0.5) * counts[static_cast<std::size_t>(height + x)];
  CoveredSamples covered;
  covered.share = all / (4.0 * width * height);
  if (all > 0) covered.middle = {static_cast<float>(sumX / all / width), static_cast<float>(sumY / all / height)};
  return covered;
}

}  // namespace windfall::test
