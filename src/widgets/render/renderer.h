// Draws a scene with OpenGL 4.5 into whatever framebuffer is bound: the viewport's or one without a window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "kernels/leaf_instance.h"
#include "kernels/math.h"
#include "sim/result.h"

namespace windfall::render {

/// 8-bit RGBA, rows from the top, sRGB with straight alpha (the renderer filters in linear, premultiplied light).
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

struct Vertex {
  vec3 position, normal;
  vec2 uv{0};
  std::uint32_t links[4]{};  ///< indices into the tree's own links
  float weights[4]{};
};

struct Material {
  vec4 baseColor{0.5f, 0.5f, 0.5f, 1};  ///< linear
  int picture = -1;                     ///< index into Mesh::pictures
  float roughness = 0.8f;
  bool foliage = false;  ///< alpha-tested, lit from both sides
};

struct Part {
  std::uint32_t firstIndex = 0, indexCount = 0;
  int material = 0;
};

/// A skinned mesh, shared by all trees of one plant.
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<Part> parts;
  std::vector<Material> materials;
  std::vector<Picture> pictures;
};

/// A tree in the scene: a mesh and where its links' matrices begin in the bone buffer.
struct TreeDraw {
  int mesh = 0;
  std::uint32_t firstLink = 0, linkCount = 0;
};

/// A layer of the leaf texture array.
struct LeafLayer {
  Picture picture;
  vec2 pivot{0.5f, 1};       ///< petiole's end in shares of the picture
  vec2 extent{0.6f, 1};      ///< width and height of the picture, in blade lengths
};

struct SceneContent {
  std::vector<Mesh> meshes;
  std::vector<TreeDraw> trees;
  std::vector<LeafLayer> leafLayers;
  std::size_t linkCount = 0, leafCount = 0;
};

/// What the simulation writes one frame into; straight in OpenGL memory, valid as long as the content is.
struct FrameSlot {
  int index = -1;
  std::span<mat4> bones;
  std::span<LeafInstance> leaves;
};

struct View {
  vec3 eye{0, 4, 16}, target{0, 4, 0};
  float fieldOfView = 0.7f;  ///< radians, vertical
  int width = 1280, height = 720;
  vec3 toSun{0.5f, 0.6f, 0.6f};
  float sunStrength = 1;
  float time = 0;                 ///< s, for clouds and grass
  vec3 wind{0};                   ///< m/s, for grass
  std::vector<std::uint32_t> highlighted;  ///< links of all trees, in the bone buffer's order
};

/// Owns every OpenGL object. All calls need the same context current; `framebuffer` is where the picture goes.
class Renderer {
 public:
  /// One clear line where there is less than OpenGL 4.5.
  static Result<std::unique_ptr<Renderer>> create();
  ~Renderer();

  /// Uploads meshes, textures and makes room for the frames. Slots handed out before are gone.
  void setContent(const SceneContent& content);
  /// A slot that the GPU does not read now. Three go round.
  FrameSlot acquire();
  /// The slot is written: the next draw shows it.
  void publish(const FrameSlot& slot);
  void draw(const View& view, unsigned framebuffer);
  /// "llvmpipe (LLVM 15.0.6, 256 bits)".
  std::string name() const;
  /// Milliseconds of the last draw on the CPU side.
  double lastDrawTime() const;

 private:
  Renderer();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// An OpenGL 4.5 context without a window or a display (EGL), current as long as it lives, with a framebuffer of its own.
class OffscreenContext {
 public:
  static Result<std::unique_ptr<OffscreenContext>> create(int width, int height);
  ~OffscreenContext();
  unsigned framebuffer() const;
  /// The framebuffer's picture, rows from the top, opaque.
  Picture read() const;

 private:
  OffscreenContext();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace windfall::render
