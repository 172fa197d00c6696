// Adaptive meshes for the renderer's tests: wavy chains that leave a trunk, each with three resolutions.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>

#include "kernels/random.h"
#include "widgets/render/content.h"

namespace windfall::test {

/// Link 0 is the trunk, link c + 1 the side chain c.
inline DetailMesh wavyMesh(std::uint64_t seed = 1, std::uint32_t sides = 30) {
  DetailMesh mesh;
  RandomSequence random(seed);
  const auto add = [&](vec3 from, vec3 along, float length, float radius, std::uint32_t count, std::uint32_t link) {
    const auto first = static_cast<std::uint32_t>(mesh.rings.size());
    const vec3 side = glm::normalize(glm::cross(along, vec3(0.3f, 0.2f, 0.9f))), other = glm::cross(along, side);
    const float wave = 0.02f * length, turns = static_cast<float>(random.uniform(4, 9));
    for (std::uint32_t i = 0; i < count; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(count - 1), angle = turns * t;
      DetailRing ring;
      ring.position =
          from + along * (length * t) + side * (wave * std::sin(angle)) + other * (wave * (std::cos(angle) - 1));
      ring.tangent =
          glm::normalize(along * length + (side * std::cos(angle) - other * std::sin(angle)) * (wave * turns));
      ring.normal = glm::normalize(side - ring.tangent * glm::dot(side, ring.tangent));
      ring.radius = radius * (1 - 0.8f * t);
      ring.v = 20 * t;
      ring.link = i == 0 && link > 0 ? 0 : link;
      mesh.rings.push_back(ring);
    }
    DetailChain chain;
    chain.middle = first + count / 2;
    chain.radius = 0.6f * length + radius;
    chain.firstEntry = static_cast<std::uint32_t>(mesh.entries.size());
    const float limits[4] = {0, 1.2e-3f, 9.6e-3f, 1e30f};
    for (std::uint32_t level = 0; level < 3; ++level) {
      const std::uint32_t step = level == 0 ? 1 : level == 1 ? 2 : count - 1;
      for (std::uint32_t i = 0; i + 1 < count; i += step) {
        DetailEntry entry;
        entry.ringA = first + i;
        entry.ringB = first + std::min(i + step, count - 1);
        entry.chain = static_cast<std::uint32_t>(mesh.chains.size());
        entry.sag = level == 0 ? 0.0004f * length : 0;
        entry.from = limits[level];
        entry.to = std::min(limits[level + 1], length);
        entry.radius = std::max(mesh.rings[entry.ringA].radius, mesh.rings[entry.ringB].radius);
        if (entry.from < entry.to) mesh.entries.push_back(entry);
      }
    }
    chain.entryCount = static_cast<std::uint32_t>(mesh.entries.size()) - chain.firstEntry;
    mesh.chains.push_back(chain);
  };
  add(vec3(0), vec3(0, 1, 0), 3, 0.12f, 17, 0);
  for (std::uint32_t c = 0; c < sides; ++c) {
    const auto angle = static_cast<float>(random.uniform(0, 6.28));
    const auto height = static_cast<float>(random.uniform(0.5, 2.9));
    const vec3 along = glm::normalize(vec3(std::cos(angle), 0.7f, std::sin(angle)));
    add(vec3(0, height, 0), along, static_cast<float>(random.uniform(0.05, 1.2)),
        static_cast<float>(random.uniform(0.002, 0.03)), 9, c + 1);
  }
  mesh.widening[8] = 0.1f;
  mesh.links = sides + 1;
  return mesh;
}

/// `trees` of it in a row, 2 m apart.
inline render::SceneContent wavyScene(std::uint32_t trees) {
  render::SceneContent content;
  content.meshes.emplace_back();
  content.details.push_back(std::make_shared<DetailMesh>(wavyMesh()));
  const std::uint32_t links = content.details[0]->links;
  for (std::uint32_t i = 0; i < trees; ++i) content.trees.push_back({0, i * links, links, 0});
  content.linkCount = std::size_t{trees} * links;
  return content;
}

/// Every link a little turned.
inline std::vector<mat4> wavyPose(const render::SceneContent& content, float sway) {
  std::vector<mat4> bones;
  for (std::size_t t = 0; t < content.trees.size(); ++t) {
    const mat4 root = glm::translate(mat4(1), vec3(2 * static_cast<float>(t), 0, -static_cast<float>(t)));
    for (std::uint32_t i = 0; i < content.trees[t].linkCount; ++i) {
      bones.push_back(
          glm::rotate(root, sway * (i == 0 ? 0.2f : 0.3f + 0.01f * static_cast<float>(i)), vec3(0, 0.1f, 1)));
    }
  }
  return bones;
}

}  // namespace windfall::test
