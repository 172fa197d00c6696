#include "widgets/render/leaf_pass.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <tuple>
#include <vector>

#include "kernels/leaf_instance.h"
#include "widgets/render/shader_program.h"

namespace windfall::render {

namespace {

/// As in leaf_layers.glsl.
struct LayerData {
  vec4 shape, gains[3], seasons[kSeasonSamples], surface, field, cover[kCoverLevels];
};

LayerData dataOf(const LeafLayer& layer, const LeafCover& cover) {
  LayerData data;
  data.shape = {layer.stalk, layer.halfWidth, layer.redness, layer.wetness};
  for (std::size_t i = 0; i < 3; ++i) data.gains[i] = vec4(glm::max(layer.gains[i], vec3(1e-3f)), 0);
  data.gains[0].w = cover.from;
  data.gains[1].w = cover.to;
  std::copy(cover.factors.begin(), cover.factors.end(), data.cover);
  data.surface = meanOver(layer.surface, layer.picture, {0.5f, 0.5f, 0.52f, 0.85f});
  data.field = meanOver(layer.ageing, layer.picture, {0.42f, 0.5f, 0.55f, 0.95f});
  std::copy(layer.seasons.begin(), layer.seasons.end(), data.seasons);
  return data;
}

}  // namespace

Status LeafPass::compile() {
  for (auto [program, vertex, fragment, define] :
       {std::tuple{&standard_, "leaf.vert", "leaf.frag", "STANDARD_QUALITY"},
        std::tuple{&high_, "leaf.vert", "leaf.frag", "HIGH_QUALITY"},
        std::tuple{&shadowProgram_, "leaf_shadow.vert", "leaf_shadow.frag", "STANDARD_QUALITY"}}) {
    Result<Program> linked = linkProgram(vertex, fragment, {define});
    if (!linked) return linked.error();
    *program = std::move(*linked);
  }
  return sort_.compile();
}

Status LeafPass::setContent(const SceneContent& content) {
  maps_.reset();
  layers_.reset();
  layerCount_ = 0;
  leaves_ = 0;
  cards_ = {};
  if (content.leafLayers.empty()) {
    if (content.leafCount == 0) return ok();
    return Error{"leaves without a leaf texture"};
  }
  if (Status uploaded = maps_.upload(content.leafLayers); !uploaded) return uploaded;
  meshes_.upload(content.leafLayers);
  if (Status made = sort_.allocate(content.leafCount, meshes_.commands()); !made) {
    maps_.reset();
    return made;
  }
  std::vector<LayerData> layers;
  for (std::size_t i = 0; i < content.leafLayers.size(); ++i) {
    layers.push_back(dataOf(content.leafLayers[i], maps_.covers()[i]));
  }
  layers_ = makeBuffer(static_cast<GLsizeiptr>(layers.size() * sizeof(LayerData)), layers.data(), 0);
  layerCount_ = layers.size();
  return ok();
}

void LeafPass::sort(GLuint buffer, GLintptr offset, const LeafSight& sight, float season,
                    const LeafCardBinding& cards) {
  leaves_ = buffer;
  offset_ = offset;
  season_ = season;
  cards_ = cards;
  if (maps_.empty()) return;
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, layers_.id());
  sort_.run(buffer, offset, sight, cards);
}

void LeafPass::bindLooks() const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, layers_.id());
  maps_.bind();
}

int LeafPass::drawKinds(std::size_t kinds) const {
  if (maps_.empty() || leaves_ == 0) return 0;
  glBindVertexArray(meshes_.array());
  bindLooks();
  glUniform1f(1, season_);
  int calls = 0;
  for (const LeafChunk& chunk : sort_.chunks()) {
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 3, leaves_, offset_ + chunk.offset,
                      static_cast<GLsizeiptr>(chunk.count * sizeof(LeafInstance)));
    cards_.bind(chunk.first, chunk.count);
    glVertexArrayVertexBuffer(meshes_.array(), 1, chunk.lists.id(), 0, sizeof(GLuint));
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, chunk.commands.id());
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(kinds * layerCount_), 0);
    ++calls;
  }
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  return calls;
}

int LeafPass::draw(bool highQuality) const {
  glUseProgram((highQuality ? high_ : standard_).id());
  glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  const int calls = drawKinds(kLeafLevels);
  glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  return calls;
}

int LeafPass::drawShadow(const mat4& lightMatrix) const {
  glUseProgram(shadowProgram_.id());
  glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(lightMatrix));
  return drawKinds(kLeafKinds);
}

}  // namespace windfall::render
