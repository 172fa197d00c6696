#include "widgets/render/leaf_sort.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <string>
#include <utility>

#include "kernels/leaf_instance.h"
#include "widgets/render/shader_program.h"

namespace windfall::render {

namespace {
constexpr std::size_t kGroup = 256;           // as in leaf_sort.comp
constexpr std::size_t kUnit = 1024;           // leaves: chunks begin where any alignment allows it
constexpr std::size_t kMostLeaves = 1 << 21;  // a chunk: what kIndexBits can name
}  // namespace

void LeafCardBinding::bind(std::size_t first, std::size_t count) const {
  glUniform1ui(4, ofLeaf != 0 ? 1 : 0);
  if (ofLeaf == 0) return;
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 9, ofLeaf, static_cast<GLintptr>(first * sizeof(GLuint)),
                    static_cast<GLsizeiptr>(count * sizeof(GLuint)));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 10, states);
}

Status LeafSort::compile() {
  for (auto [program, step] : {std::pair{&demand_, "DEMAND"}, std::pair{&count_, "COUNT"}, std::pair{&plan_, "PLAN"},
                               std::pair{&place_, "PLACE"}}) {
    Result<Program> linked = linkCompute("leaf_sort.comp", {step});
    if (!linked) return linked.error();
    *program = std::move(*linked);
  }
  return ok();
}

Status LeafSort::allocate(std::size_t leafCount, const std::vector<DrawCommand>& commands) {
  chunks_.clear();
  fresh_.reset();
  if (leafCount == 0 || commands.empty()) return ok();
  GLint largest = 0;
  glGetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
  std::size_t most = kMostLeaves;
  if (largest > 0) most = std::min(most, static_cast<std::size_t>(largest) / sizeof(LeafInstance));
  most = std::max(kUnit, most / kUnit * kUnit);
  clearErrors();
  commandBytes_ = static_cast<GLsizeiptr>(commands.size() * sizeof(DrawCommand));
  cursorBytes_ = static_cast<GLsizeiptr>(commands.size() * sizeof(GLuint));
  fresh_ = makeBuffer(commandBytes_, commands.data(), 0);
  cursors_ = makeBuffer(cursorBytes_, nullptr, 0);
  wanted_ = makeBuffer(sizeof(GLuint), nullptr, 0);
  leaves_ = leafCount;
  const std::size_t widest = std::min(most, leafCount);
  buckets_ = makeBuffer(static_cast<GLsizeiptr>(widest * sizeof(GLuint)), nullptr, 0);
  for (std::size_t first = 0; first < leafCount; first += most) {
    LeafChunk chunk;
    chunk.offset = static_cast<GLintptr>(first * sizeof(LeafInstance));
    chunk.first = first;
    chunk.count = std::min(most, leafCount - first);
    chunk.commands = makeBuffer(commandBytes_, nullptr, 0);
    chunk.lists = makeBuffer(static_cast<GLsizeiptr>(chunk.count * sizeof(GLuint)), nullptr, 0);
    chunks_.push_back(std::move(chunk));
  }
  if (outOfMemory()) {
    chunks_.clear();
    return Error{"not enough graphics memory to sort " + std::to_string(leafCount) + " leaves"};
  }
  return ok();
}

void LeafSort::bind(const LeafChunk& chunk) const {
  const GLuint buffers[] = {chunk.commands.id(), cursors_.id(), chunk.lists.id(), buckets_.id(), wanted_.id()};
  for (GLuint i = 0; i < 5; ++i) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4 + i, buffers[i]);
}

void LeafSort::run(GLuint buffer, GLintptr offset, const LeafSight& sight, const LeafCardBinding& cards) {
  const GLuint zero = 0;
  for (const LeafChunk& chunk : chunks_) {
    glCopyNamedBufferSubData(fresh_.id(), chunk.commands.id(), 0, 0, commandBytes_);
    for (const Buffer* counter : {&cursors_, &wanted_}) {
      glClearNamedBufferData(counter->id(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    }
    const float part = static_cast<float>(chunk.count) / static_cast<float>(leaves_);
    bind(chunk);
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 3, buffer, offset + chunk.offset,
                      static_cast<GLsizeiptr>(chunk.count * sizeof(LeafInstance)));
    const auto groups = static_cast<GLuint>((chunk.count + kGroup - 1) / kGroup);
    for (const Program* program : {&demand_, &count_, &plan_, &place_}) {
      glUseProgram(program->id());
      if (program != &plan_) {
        glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(sight.viewProjection));
        glUniform4f(1, sight.eye.x, sight.eye.y, sight.eye.z, sight.pixelsPerRadian);
        glUniform1ui(2, static_cast<GLuint>(chunk.count));
        glUniform2f(3, sight.thinBelow, sight.budget * part);
        if (program != &place_) cards.bind(chunk.first, chunk.count);
      }
      glDispatchCompute(program == &plan_ ? 1 : groups, 1, 1);
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
  }
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace windfall::render
