#include "widgets/render/detail_pass.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "widgets/render/bark_layers.h"
#include "widgets/render/gl_version.h"
#include "widgets/render/shader_program.h"

namespace windfall::render {

namespace {

constexpr GLbitfield kMapping = GL_MAP_WRITE_BIT | GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
constexpr GLuint kGroup = 64;  // as in detail_select.glsl
constexpr std::size_t kAlign = 256;

/// Layout of std430, as in detail.glsl.
struct TreeRecord {
  std::uint32_t firstRing = 0, ringCount = 0, firstEntry = 0, entryCount = 0;
  std::uint32_t firstChain = 0, chainCount = 0, firstLink = 0, firstSkinned = 0;
  std::uint32_t firstKey = 0, layer = 0, pad[2] = {};
  std::array<float, kDetailLevels> widening{};
};
static_assert(sizeof(TreeRecord) == 96);

std::size_t aligned(std::size_t bytes) { return (bytes + kAlign - 1) / kAlign * kAlign; }

template <class T>
Buffer uploaded(const std::vector<T>& values) {
  if (values.empty()) return {};
  return makeBuffer(static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(), 0);
}

/// What the GPU would read out of bounds is refused here.
Status check(const SceneContent& content) {
  for (const auto& mesh : content.details) {
    if (!mesh) return Error{"an adaptive mesh is missing"};
    for (const DetailEntry& entry : mesh->entries) {
      if (entry.ringA >= mesh->rings.size() || entry.ringB >= mesh->rings.size() ||
          entry.chain >= mesh->chains.size()) {
        return Error{"an adaptive mesh names a ring that is not there"};
      }
    }
    for (const DetailChain& chain : mesh->chains) {
      if (chain.middle >= mesh->rings.size() || chain.firstEntry > mesh->entries.size() ||
          chain.entryCount > mesh->entries.size() - chain.firstEntry) {
        return Error{"an adaptive mesh names a run that is not there"};
      }
    }
    for (const DetailRing& ring : mesh->rings) {
      if (ring.link >= mesh->links) return Error{"an adaptive mesh names a link that is not there"};
    }
  }
  for (const TreeDraw& tree : content.trees) {
    if (tree.detail < 0) continue;
    if (tree.detail >= static_cast<int>(content.details.size())) {
      return Error{"a tree names an adaptive mesh that is not there"};
    }
    if (content.details[static_cast<std::size_t>(tree.detail)]->links > tree.linkCount) {
      return Error{"an adaptive mesh names a link that is not there"};
    }
  }
  return ok();
}

}  // namespace

DetailCamera detailCamera(const View& view, float tolerance) {
  DetailCamera camera;
  camera.eye = view.eye;
  const float tangent = view.tangent();
  camera.scale = view.pixelsPerRadian() / std::max(tolerance, 0.01f);
  vec3 forward = view.target - view.eye;
  forward = glm::length(forward) > 1e-6f ? glm::normalize(forward) : vec3(0, 0, -1);
  const vec3 above = std::abs(forward.y) > 0.9999f ? vec3(0, 0, -1) : vec3(0, 1, 0);
  const vec3 right = glm::normalize(glm::cross(forward, above)), up = glm::cross(right, forward);
  const float wide = tangent * static_cast<float>(view.width) / static_cast<float>(std::max(1, view.height));
  const vec3 normals[4] = {forward * wide + right, forward * wide - right, forward * tangent + up,
                           forward * tangent - up};
  for (std::size_t i = 0; i < 4; ++i) {
    const vec3 n = glm::normalize(normals[i]);
    camera.planes[i] = vec4(n, -glm::dot(n, view.eye));
  }
  return camera;
}

DetailCamera shadowDetailCamera(float texel) {
  DetailCamera camera;
  camera.parallel = 1;
  camera.scale = 1 / std::max(texel, 1e-6f);
  return camera;
}

DetailPass::Lists::~Lists() { release(); }

void DetailPass::Lists::release() {
  for (GLsync& fence : fences) {
    if (fence != nullptr) glDeleteSync(fence);
    fence = nullptr;
  }
  memory.reset();
  mapped = nullptr;
  slot = 0;
}

Status DetailPass::compile() {
  chooser_ = isSoftware() ? Chooser::Cpu : Chooser::Gpu;
  const auto take = [](Program& into, Result<Program> linked) -> Status {
    if (!linked) return linked.error();
    into = std::move(*linked);
    return ok();
  };
  for (const Status& status :
       {take(wood_[0][0], linkProgram("detail.vert", "tree.frag", {"STANDARD_QUALITY", "LAYERED"})),
        take(wood_[1][0], linkProgram("detail.vert", "tree.frag", {"HIGH_QUALITY", "LAYERED"})),
        take(wood_[0][1], linkProgram("detail.vert", "tree.frag", {"STANDARD_QUALITY", "LAYERED", "PICTURED"})),
        take(wood_[1][1], linkProgram("detail.vert", "tree.frag", {"HIGH_QUALITY", "LAYERED", "PICTURED"})),
        take(thin_[0], linkProgram("detail.vert", "detail_thin.frag", {"STANDARD_QUALITY", "THIN"})),
        take(thin_[1], linkProgram("detail.vert", "detail_thin.frag", {"HIGH_QUALITY", "THIN"})),
        take(shadow_, linkProgram("detail_shadow.vert", "detail_shadow.frag")),
        take(skin_, linkCompute("detail_skin.comp")), take(count_, linkCompute("detail_count.comp")),
        take(offset_, linkCompute("detail_offset.comp")), take(list_, linkCompute("detail_list.comp"))}) {
    if (!status) return status;
  }
  return ok();
}

Status DetailPass::setContent(const SceneContent& content) {
  trees_.clear();
  selector_.setTrees({});
  for (Lists& lists : lists_) lists.release();
  if (const Status sound = check(content); !sound) return sound;
  std::vector<DetailRing> rings;
  std::vector<DetailEntry> entries;
  std::vector<DetailChain> chains;
  std::vector<TreeRecord> meshes, records;
  for (const auto& mesh : content.details) {
    TreeRecord record;
    record.firstRing = static_cast<std::uint32_t>(rings.size());
    record.firstEntry = static_cast<std::uint32_t>(entries.size());
    record.firstChain = static_cast<std::uint32_t>(chains.size());
    record.ringCount = static_cast<std::uint32_t>(mesh->rings.size());
    record.entryCount = static_cast<std::uint32_t>(mesh->entries.size());
    record.chainCount = static_cast<std::uint32_t>(mesh->chains.size());
    record.widening = mesh->widening;
    meshes.push_back(record);
    rings.insert(rings.end(), mesh->rings.begin(), mesh->rings.end());
    entries.insert(entries.end(), mesh->entries.begin(), mesh->entries.end());
    chains.insert(chains.end(), mesh->chains.begin(), mesh->chains.end());
  }
  std::vector<DetailTree> trees;
  BarkLayers barks(content);
  ringCount_ = entryCount_ = largestRings_ = largestEntries_ = 0;
  for (const TreeDraw& tree : content.trees) {
    if (tree.detail < 0) continue;
    TreeRecord record = meshes[static_cast<std::size_t>(tree.detail)];
    if (record.entryCount == 0) continue;
    record.firstLink = tree.firstLink;
    record.firstSkinned = static_cast<std::uint32_t>(ringCount_);
    record.firstKey = static_cast<std::uint32_t>(entryCount_);
    record.layer = barks.layerOf(tree.mesh);
    trees.push_back({content.details[static_cast<std::size_t>(tree.detail)], record.firstLink, record.firstSkinned,
                     record.firstKey, record.layer});
    ringCount_ += record.ringCount;
    entryCount_ += record.entryCount;
    largestRings_ = std::max<std::size_t>(largestRings_, record.ringCount);
    largestEntries_ = std::max<std::size_t>(largestEntries_, record.entryCount);
    records.push_back(record);
  }
  if (trees.empty()) return ok();
  clearErrors();
  rings_ = uploaded(rings);
  entries_ = uploaded(entries);
  chains_ = uploaded(chains);
  treeTable_ = uploaded(records);
  barks_ = barks.upload();
  if (const Status made = allocate(); !made) return made;
  selector_.setTrees(trees);
  trees_ = std::move(trees);
  return ok();
}

Status DetailPass::allocate() {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
  if (largest > 0 && ringCount_ * sizeof(SkinnedRing) > static_cast<std::size_t>(largest)) {
    return Error{"too many rings for this graphics device: " + std::to_string(ringCount_)};
  }
  if (!array_) {
    grids_ = makeDetailGrids();
    gridVertices_ = uploaded(grids_.vertices);
    gridIndices_ = uploaded(grids_.indices);
    template_ = makeBuffer(sizeof grids_.commands, grids_.commands.data(), 0);
    cursors_ = makeBuffer(kDetailGrids * sizeof(std::uint32_t), nullptr, 0);
    array_ = makeVertexArray();
    const GLuint array = array_.id();
    glVertexArrayVertexBuffer(array, 0, gridVertices_.id(), 0, sizeof(GridVertex));
    glVertexArrayElementBuffer(array, gridIndices_.id());
    glEnableVertexArrayAttrib(array, 0);
    glVertexArrayAttribIFormat(array, 0, 4, GL_UNSIGNED_BYTE, 0);
    glVertexArrayAttribBinding(array, 0, 0);
    glEnableVertexArrayAttrib(array, 1);
    glVertexArrayAttribIFormat(array, 1, 3, GL_UNSIGNED_INT, 0);
    glVertexArrayAttribBinding(array, 1, 1);
    glVertexArrayBindingDivisor(array, 1, 1);
  }
  keys_ = makeBuffer(static_cast<GLsizeiptr>(entryCount_ * sizeof(std::uint32_t)), nullptr, 0);
  runOffset_ = aligned(ringCount_ * sizeof(SkinnedRing));
  commandOffset_ = aligned(runOffset_ + entryCount_ * sizeof(DetailRun));
  slotBytes_ = aligned(commandOffset_ + sizeof grids_.commands);
  for (Lists& lists : lists_) {
    const auto bytes = static_cast<GLsizeiptr>(slotBytes_ * kSlots);
    lists.memory = makeBuffer(bytes, nullptr, kMapping);
    lists.mapped = static_cast<std::byte*>(glMapNamedBufferRange(lists.memory.id(), 0, bytes, kMapping));
    if (outOfMemory() || lists.mapped == nullptr) {
      for (Lists& all : lists_) all.release();
      return Error{"not enough graphics memory for the adaptive meshes"};
    }
    for (int slot = 0; slot < kSlots; ++slot) {
      std::memcpy(lists.mapped + slotBytes_ * static_cast<std::size_t>(slot) + commandOffset_, grids_.commands.data(),
                  sizeof grids_.commands);
    }
  }
  return ok();
}

void DetailPass::choose(Target target, const DetailCamera& camera, std::span<const mat4> bones) {
  if (trees_.empty()) return;
  Lists& lists = this->lists(target);
  lists.slot = (lists.slot + 1) % kSlots;
  GLsync& fence = lists.fences[static_cast<std::size_t>(lists.slot)];
  if (fence != nullptr) {
    glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, 1'000'000'000);
    glDeleteSync(fence);
    fence = nullptr;
  }
  if (chooser_ == Chooser::Gpu) {
    chooseOnGpu(lists, camera);
  } else {
    chooseOnCpu(lists, camera, bones);
  }
}

void DetailPass::chooseOnCpu(Lists& lists, const DetailCamera& camera, std::span<const mat4> bones) {
  std::byte* slot = lists.mapped + slotOffset(lists);
  const auto counts = selector_.select(camera, bones, {reinterpret_cast<SkinnedRing*>(slot), ringCount_},
                                       {reinterpret_cast<DetailRun*>(slot + runOffset_), entryCount_});
  auto commands = grids_.commands;
  std::uint32_t first = 0;
  for (std::size_t g = 0; g < kDetailGrids; ++g) {
    commands[g].instances = counts[g];
    commands[g].baseInstance = first;
    first += counts[g];
  }
  std::memcpy(slot + commandOffset_, commands.data(), sizeof commands);
}

void DetailPass::chooseOnGpu(Lists& lists, const DetailCamera& camera) {
  const auto offset = static_cast<GLintptr>(slotOffset(lists));
  const GLuint memory = lists.memory.id();
  glCopyNamedBufferSubData(template_.id(), memory, 0, offset + static_cast<GLintptr>(commandOffset_),
                           sizeof grids_.commands);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 11, rings_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, entries_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, chains_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, treeTable_.id());
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 6, memory, offset, static_cast<GLsizeiptr>(runOffset_));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, keys_.id());
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 8, memory, offset + static_cast<GLintptr>(commandOffset_),
                    sizeof grids_.commands);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 9, cursors_.id());
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 10, memory, offset + static_cast<GLintptr>(runOffset_),
                    static_cast<GLsizeiptr>(commandOffset_ - runOffset_));
  const auto trees = static_cast<GLuint>(trees_.size());
  const auto groups = [](std::size_t items) { return static_cast<GLuint>((items + kGroup - 1) / kGroup); };
  const std::pair<const Program*, std::pair<GLuint, GLuint>> passes[] = {{&skin_, {groups(largestRings_), trees}},
                                                                         {&count_, {groups(largestEntries_), trees}},
                                                                         {&offset_, {1, 1}},
                                                                         {&list_, {groups(largestEntries_), trees}}};
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  for (const auto& [program, size] : passes) {
    glUseProgram(program->id());
    glUniform4f(0, camera.eye.x, camera.eye.y, camera.eye.z, camera.scale);
    glUniform4fv(1, 4, glm::value_ptr(camera.planes[0]));
    glUniform1f(5, camera.parallel);
    glDispatchCompute(size.first, size.second, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
}

void DetailPass::drawGrids(const Lists& lists, std::size_t first, std::size_t last) const {
  const auto offset = static_cast<GLintptr>(slotOffset(lists));
  glBindVertexArray(array_.id());
  glVertexArrayVertexBuffer(array_.id(), 1, lists.memory.id(), offset + static_cast<GLintptr>(runOffset_),
                            sizeof(DetailRun));
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 6, lists.memory.id(), offset, static_cast<GLsizeiptr>(runOffset_));
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, lists.memory.id());
  const std::size_t commands = slotOffset(lists) + commandOffset_ + first * sizeof(GridCommand);
  // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL wants an offset so
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, reinterpret_cast<const void*>(commands),
                              static_cast<GLsizei>(last - first), 0);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
}

void DetailPass::fence(Lists& lists) {
  GLsync& fence = lists.fences[static_cast<std::size_t>(lists.slot)];
  if (fence != nullptr) glDeleteSync(fence);
  fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

int DetailPass::draw(bool highQuality) {
  if (trees_.empty()) return 0;
  Lists& chosen = lists(Target::Picture);
  barks_.bind();
  // Stems are closed: their far sides are behind the near ones.
  glEnable(GL_CULL_FACE);
  // The grids of three sides come first; nobody sees a picture on them.
  glUseProgram(thin_[highQuality ? 1 : 0].id());
  drawGrids(chosen, 0, kDetailAxial);
  glUseProgram(wood_[highQuality ? 1 : 0][barks_.allPictured ? 1 : 0].id());
  drawGrids(chosen, kDetailAxial, kDetailGrids);
  glDisable(GL_CULL_FACE);
  fence(chosen);
  return 2;
}

int DetailPass::drawShadow(const mat4& lightMatrix) {
  if (trees_.empty()) return 0;
  glUseProgram(shadow_.id());
  glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(lightMatrix));
  Lists& chosen = lists(Target::Shadow);
  drawGrids(chosen, 0, kDetailGrids);
  fence(chosen);
  return 1;
}

std::array<GridCommand, kDetailGrids> DetailPass::commands(const Lists& lists) const {
  std::array<GridCommand, kDetailGrids> out{};
  if (trees_.empty()) return out;
  if (chooser_ == Chooser::Gpu) glFinish();
  std::memcpy(out.data(), lists.mapped + slotOffset(lists) + commandOffset_, sizeof out);
  return out;
}

DetailCounts DetailPass::counts() const {
  DetailCounts counts;
  const auto drawn = commands(lists(Target::Picture));
  for (std::size_t g = 0; g < kDetailGrids; ++g) {
    counts.runs[g] = drawn[g].instances;
    counts.vertices += std::size_t{drawn[g].instances} * grids_.vertexCount[g];
    counts.triangles += std::size_t{drawn[g].instances} * drawn[g].count / 3;
  }
  return counts;
}

std::vector<DetailRun> DetailPass::runs(Target target) const {
  std::size_t count = 0;
  for (const GridCommand& command : commands(lists(target))) count += command.instances;
  std::vector<DetailRun> out(count);
  if (count > 0) {
    std::memcpy(out.data(), lists(target).mapped + slotOffset(lists(target)) + runOffset_, count * sizeof(DetailRun));
  }
  return out;
}

std::vector<SkinnedRing> DetailPass::rings(Target target) const {
  std::vector<SkinnedRing> out(trees_.empty() ? 0 : ringCount_);
  if (chooser_ == Chooser::Gpu) glFinish();
  if (!out.empty()) {
    std::memcpy(out.data(), lists(target).mapped + slotOffset(lists(target)), ringCount_ * sizeof(SkinnedRing));
  }
  return out;
}

void DetailPass::bindRings(Target target) const {
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 6, lists(target).memory.id(),
                    static_cast<GLintptr>(slotOffset(lists(target))), static_cast<GLsizeiptr>(runOffset_));
}

}  // namespace windfall::render
