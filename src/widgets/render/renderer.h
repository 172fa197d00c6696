// Draws a scene with OpenGL 4.5 into whatever framebuffer is bound: the viewport's or one without a window.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "kernels/leaf_instance.h"
#include "kernels/math.h"
#include "sim/result.h"
#include "widgets/render/content.h"
#include "widgets/render/view.h"

namespace windfall::render {

/// What the simulation writes one frame into; straight in OpenGL memory, valid as long as the content is.
/// Write only: reading back from it may be very slow.
struct FrameSlot {
  int index = -1;         ///< -1: none was free
  std::span<mat4> bones;  ///< a matrix a link: rest space of its tree to world
  std::span<LeafInstance> leaves;
};

/// What the last draw asked of OpenGL.
struct DrawCounts {
  int calls = 0;            ///< draw calls of all passes
  int leafCalls = 0;        ///< of them, leaves in the picture itself (shadows not counted)
  int cardCalls = 0;        ///< of them, cards of leaves in the picture
  bool unfinished = false;  ///< cards are still being painted: a further draw shows more of them
  int slot = -1;            ///< frame slot that was shown, -1: none was published yet
};

/// Owns every OpenGL object. All calls, the destructor's too, need the same context current; `framebuffer` is where the
/// picture goes. OpenGL's state afterwards: defaults, with `framebuffer` bound.
class Renderer {
 public:
  /// One clear line where there is less than OpenGL 4.5.
  static Result<std::unique_ptr<Renderer>> create();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Uploads meshes, textures and makes room for the frames. Slots handed out before are gone.
  /// Fails where the content names what it does not have, or where memory is short; then nothing is drawn but ground
  /// and sky.
  Status setContent(const SceneContent& content);
  /// A slot that the GPU does not read now. Three go round; waits for the GPU if need be. It may be written on another
  /// thread. Two may be held at a time; a third gets index -1.
  FrameSlot acquire();
  /// The slot is written: the next draw shows it.
  void publish(const FrameSlot& slot);
  /// Fails only where the picture's own memory cannot be had.
  Status draw(const View& view, unsigned framebuffer);
  /// "llvmpipe (LLVM 15.0.6, 256 bits)".
  std::string name() const;
  /// Whether a processor draws instead of a graphics card.
  bool isSoftware() const;
  /// Milliseconds of the last draw on the CPU side.
  double lastDrawTime() const;
  DrawCounts lastDraw() const;
  /// Multisampled depth of the last picture, 0 where only sky is seen; for tests.
  unsigned depth() const;

 private:
  Renderer();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace windfall::render
