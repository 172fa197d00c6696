// Draws the skinned trees, into the picture and into the shadow map.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sim/result.h"
#include "widgets/render/content.h"
#include "widgets/render/gl_object.h"
#include "widgets/render/part_pieces.h"

namespace windfall::render {

/// An axis-aligned box; empty until something is added.
struct Bounds {
  vec3 lower{1e30f}, upper{-1e30f};
  bool empty() const { return lower.x > upper.x; }
  void add(const vec3& point);
};

class TreePass {
 public:
  Status compile();
  /// Uploads meshes and pictures; checks every index and link.
  Status setContent(const SceneContent& content);
  /// Draw calls made; `adaptive` leaves out the wood that adaptive meshes stand for. The frame's uniforms, bones
  /// (storage 0) and highlights (storage 1) are bound by the caller.
  int draw(bool highQuality, bool adaptive, const PieceSight& sight, std::span<const mat4> bones);
  int drawShadow(const mat4& lightMatrix, bool adaptive, const PieceSight& sight, std::span<const mat4> bones);
  const std::vector<TreeDraw>& trees() const { return trees_; }
  /// Some tree's wood is there as an adaptive mesh alone.
  bool needsAdaptive() const { return needsAdaptive_; }
  /// Of a mesh at rest, with the adaptive one that stands for parts of it.
  const Bounds& bounds(int mesh) const { return meshes_[static_cast<std::size_t>(mesh)].bounds; }

 private:
  struct GpuMesh {
    VertexArray array;
    Buffer vertices, indices, instances;
    std::vector<Part> parts;
    std::vector<std::optional<PartPieces>> pieces;  ///< of each part
    std::vector<Material> materials;
    std::vector<Texture> pictures;
    GLsizei instanceCount = 0;
    bool detailed = false;  ///< its wood has an adaptive mesh
    Bounds bounds;
  };
  static int drawPart(GpuMesh& mesh, std::size_t index, const PieceSight& sight, std::span<const mat4> bones);
  static Status upload(const Mesh& mesh, const std::vector<std::uint32_t>& firstLinks, GpuMesh& out);

  std::vector<GpuMesh> meshes_;
  std::vector<TreeDraw> trees_;
  bool needsAdaptive_ = false;
  Program wood_[2][2];                                     ///< [high quality][with a picture]
  Program foliage_[2], pieces_[2], shadow_, pieceShadow_;  ///< [1]: high quality
};

}  // namespace windfall::render
