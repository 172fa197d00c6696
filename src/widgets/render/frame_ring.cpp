#include "widgets/render/frame_ring.h"

#include <algorithm>

namespace windfall::render {

namespace {

constexpr GLbitfield kMapping = GL_MAP_WRITE_BIT | GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;

std::size_t aligned(std::size_t bytes, std::size_t alignment) {
  return (bytes + alignment - 1) / alignment * alignment;
}

}  // namespace

FrameRing::~FrameRing() { release(); }

void FrameRing::release() {
  for (Slot& slot : slots_) {
    if (slot.fence != nullptr) glDeleteSync(slot.fence);
    slot = Slot{};
  }
  bones_.reset();
  leaves_.reset();
  boneMemory_ = leafMemory_ = nullptr;
  linkCount_ = leafCount_ = 0;
  newest_ = -1;
  last_ = kSlots - 1;
}

Status FrameRing::allocate(std::size_t linkCount, std::size_t leafCount) {
  release();
  GLint alignment = 256, largest = 0;
  glGetIntegerv(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT, &alignment);
  glGetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
  const std::size_t unit = std::max<std::size_t>(static_cast<std::size_t>(alignment), 256);
  boneStride_ = aligned(std::max<std::size_t>(linkCount, 1) * sizeof(mat4), unit);
  leafStride_ = aligned(std::max<std::size_t>(leafCount, 1) * sizeof(LeafInstance), unit);
  if (largest > 0 && boneStride_ > static_cast<std::size_t>(largest)) {
    return Error{"too many branches for this graphics device: " + std::to_string(linkCount)};
  }
  clearErrors();
  bones_ = makeBuffer(static_cast<GLsizeiptr>(boneStride_ * kSlots), nullptr, kMapping);
  leaves_ = makeBuffer(static_cast<GLsizeiptr>(leafStride_ * kSlots), nullptr, kMapping);
  if (!outOfMemory()) {
    boneMemory_ = static_cast<std::byte*>(
        glMapNamedBufferRange(bones_.id(), 0, static_cast<GLsizeiptr>(boneStride_ * kSlots), kMapping));
    leafMemory_ = static_cast<std::byte*>(
        glMapNamedBufferRange(leaves_.id(), 0, static_cast<GLsizeiptr>(leafStride_ * kSlots), kMapping));
  }
  if (boneMemory_ == nullptr || leafMemory_ == nullptr) {
    clearErrors();
    release();
    return Error{"not enough graphics memory for " + std::to_string(leafCount) + " leaves and " +
                 std::to_string(linkCount) + " links"};
  }
  linkCount_ = linkCount;
  leafCount_ = leafCount;
  return ok();
}

void FrameRing::wait(Slot& slot) {
  if (slot.fence == nullptr) return;
  constexpr GLuint64 second = 1'000'000'000;
  while (glClientWaitSync(slot.fence, GL_SYNC_FLUSH_COMMANDS_BIT, second) == GL_TIMEOUT_EXPIRED) {
  }
  glDeleteSync(slot.fence);
  slot.fence = nullptr;
}

FrameSlot FrameRing::acquire() {
  if (boneMemory_ == nullptr) return {};
  // Round robin: the slot that was shown longest ago is the one that the GPU has most likely finished with.
  for (int step = 1; step <= kSlots; ++step) {
    const int index = (last_ + step) % kSlots;
    Slot& candidate = slots_[static_cast<std::size_t>(index)];
    if (candidate.held || index == newest_) continue;
    wait(candidate);
    candidate.held = true;
    last_ = index;
    return slot(index);
  }
  return {};
}

FrameSlot FrameRing::slot(int index) const {
  return {index,
          {reinterpret_cast<mat4*>(boneMemory_ + boneOffset(index)), linkCount_},
          {reinterpret_cast<LeafInstance*>(leafMemory_ + leafOffset(index)), leafCount_}};
}

void FrameRing::publish(int index) {
  if (index < 0 || index >= kSlots || !slots_[static_cast<std::size_t>(index)].held) return;
  slots_[static_cast<std::size_t>(index)].held = false;
  newest_ = index;
}

void FrameRing::fence(int index) {
  Slot& slot = slots_[static_cast<std::size_t>(index)];
  if (slot.fence != nullptr) glDeleteSync(slot.fence);
  slot.fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

}  // namespace windfall::render
