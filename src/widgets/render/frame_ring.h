// Three frame slots in persistently mapped memory: the simulation writes one while the GPU reads another.
#pragma once

#include <array>
#include <cstddef>

#include "sim/result.h"
#include "widgets/render/gl_object.h"
#include "widgets/render/renderer.h"

namespace windfall::render {

/// Owns the buffers of bones and leaves. Nothing is copied or allocated after `allocate`.
class FrameRing {
 public:
  static constexpr int kSlots = 3;

  FrameRing() = default;
  ~FrameRing();
  FrameRing(const FrameRing&) = delete;
  FrameRing& operator=(const FrameRing&) = delete;

  /// Maps room for three frames; slots handed out before are gone.
  Status allocate(std::size_t linkCount, std::size_t leafCount);
  /// A slot that is neither held nor shown nor read by the GPU; waits for the GPU if need be. Index -1: two are held.
  FrameSlot acquire();
  void publish(int index);
  /// The newest published slot, -1: none.
  int newest() const { return newest_; }
  /// Of a published slot: what was written.
  FrameSlot slot(int index) const;
  /// The GPU was told to read the slot: it is not handed out before it has.
  void fence(int index);

  GLuint bones() const { return bones_.id(); }
  GLuint leaves() const { return leaves_.id(); }
  GLintptr boneOffset(int index) const { return static_cast<GLintptr>(boneStride_) * index; }
  GLintptr leafOffset(int index) const { return static_cast<GLintptr>(leafStride_) * index; }
  std::size_t linkCount() const { return linkCount_; }
  std::size_t leafCount() const { return leafCount_; }

 private:
  struct Slot {
    bool held = false;
    GLsync fence = nullptr;
  };
  void wait(Slot& slot);
  void release();

  Buffer bones_, leaves_;
  std::byte* boneMemory_ = nullptr;
  std::byte* leafMemory_ = nullptr;
  std::size_t boneStride_ = 0, leafStride_ = 0, linkCount_ = 0, leafCount_ = 0;
  std::array<Slot, kSlots> slots_{};
  int newest_ = -1, last_ = kSlots - 1;
};

}  // namespace windfall::render
