#include "widgets/render/leaf_cards.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <tuple>

#include "sim/tree.h"
#include "widgets/render/leaf_pass.h"
#include "widgets/render/shader_program.h"

namespace windfall::render {

namespace {

constexpr int kQuietFrames = 2;      // a content's first pictures are not kept waiting
constexpr float kFadeRange = 1.35f;  // as in card_choose.comp
constexpr float kSeasonStep = 1.0f / 64;

/// As OpenGL reads it.
struct ArraysCommand {
  GLuint count = 4, instances = 0, first = 0, baseInstance = 0;
};

float meanLength(const sim::Tree& tree) {
  const std::size_t stride = std::max<std::size_t>(1, tree.sites.size() / 256);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < tree.sites.size(); i += stride, ++count) sum += static_cast<double>(tree.sites[i].size);
  return count > 0 ? static_cast<float>(sum / count) : 0;
}

float reach(const sim::Tree& tree) {
  float farthest = 0;
  for (const sim::Link& link : tree.links) farthest = std::max(farthest, glm::length(link.joint) + link.length);
  return farthest;
}

}  // namespace

LeafCards::~LeafCards() { stopPlanning(); }

void LeafCards::stopPlanning() {
  if (stop_) stop_->store(true);
  if (planning_.valid()) planning_.wait();
  planning_ = {};
  stop_.reset();
}

Status LeafCards::compile() {
  using Source = std::tuple<Program*, const char*, std::vector<std::string>>;
  for (const auto& [program, name, defines] :
       {Source{&fade_, "card_choose.comp", {"FADE"}}, Source{&list_, "card_choose.comp", {"LIST"}}}) {
    Result<Program> linked = linkCompute(name, defines);
    if (!linked) return linked.error();
    *program = std::move(*linked);
  }
  for (const auto& [program, name, defines] :
       {Source{&cards_[0], "", {"STANDARD_QUALITY"}}, Source{&cards_[1], "", {"HIGH_QUALITY"}},
        Source{&shadow_, "", {"STANDARD_QUALITY", "SHADOW"}}}) {
    Result<Program> linked = linkProgram("card.vert", "card.frag", defines);
    if (!linked) return linked.error();
    *program = std::move(*linked);
    std::vector<vec3> views;
    for (std::size_t i = 0; i < kCardViews; ++i) views.push_back(cardView(i));
    glProgramUniform3fv(program->id(), 8, static_cast<GLsizei>(kCardViews), glm::value_ptr(views.front()));
  }
  return painter_.compile();
}

void LeafCards::setContent(const SceneContent& content, const LeafPass& leaves) {
  stopPlanning();
  set_.reset();
  source_.reset();
  kinds_.clear();
  pictures_.clear();
  shown_.clear();
  painter_.release();
  for (Buffer* buffer : {&nodes_, &instances_, &states_, &lists_, &ofLeaf_, &commands_, &fresh_}) buffer->reset();
  frames_ = 0;
  active_ = failed_ = false;
  if (content.leafCount == 0 || content.leafLayers.empty() || content.leafTrees.size() != content.trees.size()) return;
  source_ = std::make_shared<SceneContent>();
  source_->trees = content.trees;
  source_->leafTrees = content.leafTrees;
  source_->leafCount = content.leafCount;
  source_->leafSeed = content.leafSeed;
  std::map<const sim::Tree*, std::size_t> known;
  for (std::size_t t = 0; t < content.trees.size(); ++t) {
    const sim::Tree& tree = *content.leafTrees[t];
    if (tree.sites.empty()) continue;
    const auto [place, isNew] = known.try_emplace(&tree, kinds_.size());
    if (isNew) kinds_.push_back({meanLength(tree), reach(tree), {}});
    kinds_[place->second].firstLinks.push_back(content.trees[t].firstLink);
  }
  painter_.setMeshes(leaves.meshes(), content.leafLayers.size());
}

bool LeafCards::wanted(float length, float radius, const std::vector<std::uint32_t>& firstLinks, const CardSight& sight,
                       std::span<const mat4> bones) const {
  return std::any_of(firstLinks.begin(), firstLinks.end(), [&](std::uint32_t link) {
    if (link >= bones.size()) return false;
    const float farthest = glm::distance(vec3(bones[link][3]), sight.eye) + radius;
    return length * sight.pixelsPerRadian < kFadeRange * sight.below * farthest;
  });
}

bool LeafCards::planned(const CardSight& sight, std::span<const mat4> bones) {
  if (set_) return true;
  if (!planning_.valid()) {
    const bool far = std::any_of(kinds_.begin(), kinds_.end(), [&](const Kind& kind) {
      return wanted(kind.length, kind.radius, kind.firstLinks, sight, bones);
    });
    unfinished_ = far;
    if (!far || (frames_ <= kQuietFrames && !sight.whole)) return false;
    stop_ = std::make_shared<std::atomic<bool>>(false);
    planning_ = std::async(std::launch::async, [source = source_, stop = stop_] { return makeCards(*source, *stop); });
  }
  unfinished_ = true;
  if (!sight.whole && planning_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
  unfinished_ = false;
  set_ = planning_.get();
  upload();
  return true;
}

void LeafCards::upload() {
  const CardSet& set = *set_;
  pictures_.resize(set.plants.size());
  shown_.assign(set.plants.size(), false);
  if (set.plants.empty()) return;
  clearErrors();
  const auto bytes = [](const auto& of) { return static_cast<GLsizeiptr>(of.size() * sizeof(of[0])); };
  nodes_ = makeBuffer(bytes(set.nodes), set.nodes.data(), 0);
  instances_ = makeBuffer(bytes(set.instances), set.instances.data(), 0);
  ofLeaf_ = makeBuffer(bytes(set.ofLeaf), set.ofLeaf.data(), 0);
  const auto count = static_cast<GLsizeiptr>(set.instances.size());
  states_ = makeBuffer(count * 2 * static_cast<GLsizeiptr>(sizeof(GLuint)), nullptr, 0);
  lists_ = makeBuffer(count * 4 * static_cast<GLsizeiptr>(sizeof(GLuint)), nullptr, 0);
  std::vector<ArraysCommand> commands;
  for (const CardPlant& plant : set.plants) commands.push_back({4, 0, 0, plant.firstInstance});
  commands_ = makeBuffer(bytes(commands), nullptr, 0);
  fresh_ = makeBuffer(bytes(commands), commands.data(), 0);
  array_ = makeVertexArray();
  glEnableVertexArrayAttrib(array_.id(), 0);
  glVertexArrayAttribIFormat(array_.id(), 0, 4, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(array_.id(), 0, 0);
  glVertexArrayBindingDivisor(array_.id(), 0, 1);
  glVertexArrayVertexBuffer(array_.id(), 0, lists_.id(), 0, 4 * sizeof(GLuint));
  failed_ = outOfMemory();
}

void LeafCards::paint(const CardSight& sight, const std::vector<bool>& wanted, const LeafPass& leaves) {
  const float season = std::round(sight.season / kSeasonStep) * kSeasonStep;
  bool bound = false, missing = false;
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    if (!wanted[i] || pictures_[i].season == season) continue;
    if (!bound) leaves.bindLooks();
    bound = true;
    const Result<bool> done = painter_.paint(i, set_->plants[i], set_->nodes, season,
                                             sight.whole ? ~std::size_t{0} : sight.pace, pictures_[i]);
    // Without memory for cards every leaf is drawn, as before.
    if (!done) failed_ = true;
    missing = !done || !*done;
    if (missing) break;
  }
  unfinished_ = missing && !failed_;
  if (bound && !missing) painter_.release();
}

LeafCardBinding LeafCards::choose(const CardSight& sight, std::span<const mat4> bones, const LeafPass& leaves) {
  active_ = unfinished_ = false;
  ++frames_;
  if (!source_ || failed_ || !(sight.below > 0) || bones.empty() || !planned(sight, bones)) return {};
  if (failed_ || set_->plants.empty()) return {};
  std::vector<bool> wantedNow(pictures_.size());
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    const CardPlant& plant = set_->plants[i];
    wantedNow[i] = plant.leafLength > 0 && wanted(plant.leafLength, plant.radius, plant.firstLinks, sight, bones);
  }
  paint(sight, wantedNow, leaves);
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    shown_[i] = !failed_ && wantedNow[i] && !pictures_[i].empty();
    active_ = active_ || shown_[i];
  }
  if (!active_) return {};
  pixelsPerRadian_ = sight.pixelsPerRadian;
  dispatch(fade_, sight);
  return {ofLeaf_.id(), states_.id()};
}

void LeafCards::dispatch(const Program& program, const CardSight& sight) const {
  glUseProgram(program.id());
  glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(sight.viewProjection));
  glUniform4f(1, sight.eye.x, sight.eye.y, sight.eye.z, sight.pixelsPerRadian);
  const GLuint buffers[] = {nodes_.id(), instances_.id(), lists_.id()};
  for (GLuint i = 0; i < 3; ++i) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4 + i, buffers[i]);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 8, commands_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 10, states_.id());
  for (std::size_t i = 0; i < set_->plants.size(); ++i) {
    const CardPlant& plant = set_->plants[i];
    // Those that are not shown get no share of cards.
    glUniform4ui(2, plant.firstInstance, plant.instanceCount, plant.firstNode, static_cast<GLuint>(i));
    glUniform2f(3, shown_[i] ? sight.below : 1e-9f, static_cast<float>(plant.tile));
    glDispatchCompute((plant.instanceCount + 63) / 64, 1, 1);
  }
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void LeafCards::list(const CardSight& sight) {
  if (!active_) return;
  glCopyNamedBufferSubData(fresh_.id(), commands_.id(), 0, 0,
                           static_cast<GLsizeiptr>(set_->plants.size() * sizeof(ArraysCommand)));
  dispatch(list_, sight);
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

int LeafCards::drawPlants(float scale) const {
  glBindVertexArray(array_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, nodes_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, instances_.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.id());
  int calls = 0;
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    if (!shown_[i]) continue;
    glBindTextureUnit(3, pictures_[i].colours.id());
    glBindTextureUnit(4, pictures_[i].surfaces.id());
    glUniform4f(2, scale, static_cast<float>(set_->plants[i].tile), 0, 0);
    glDrawArraysIndirect(
        GL_TRIANGLE_STRIP,
        reinterpret_cast<const void*>(i * sizeof(ArraysCommand)));  // NOLINT: an offset, as OpenGL wants
    ++calls;
  }
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  return calls;
}

int LeafCards::draw(bool highQuality, float season) {
  if (!active_) return 0;
  glUseProgram(cards_[highQuality ? 1 : 0].id());
  glUniform1f(1, season);
  return drawPlants(pixelsPerRadian_);
}

int LeafCards::drawShadow(const mat4& lightMatrix, float texelsPerMetre) {
  if (!active_) return 0;
  glUseProgram(shadow_.id());
  glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(lightMatrix));
  return drawPlants(texelsPerMetre);
}

std::size_t LeafCards::listed() const {
  if (!active_) return 0;
  std::vector<ArraysCommand> commands(set_->plants.size());
  glGetNamedBufferSubData(commands_.id(), 0, static_cast<GLsizeiptr>(commands.size() * sizeof(ArraysCommand)),
                          commands.data());
  std::size_t count = 0;
  for (const ArraysCommand& command : commands) count += command.instances;
  return count;
}

}  // namespace windfall::render
