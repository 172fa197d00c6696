#include "widgets/render/card_pictures.h"

#include <algorithm>

#include "widgets/render/shader_program.h"

namespace windfall::render {

namespace {

constexpr int kSide = 512, kLevels = 5;  // px of the target, levels of a picture
constexpr GLuint kWhole = 512u << 21u;   // of leaf_layers.glsl: drawn in its own size
constexpr std::size_t kShape = 2;        // level of a leaf's mesh

/// As in card_bake.vert.
struct CardTile {
  vec4 sphere, direction, frame;
};

Texture samplesOf(GLenum format) {
  Texture texture = makeTexture(GL_TEXTURE_2D_MULTISAMPLE);
  glTextureStorage2DMultisample(texture.id(), 4, format, kSide, kSide, GL_TRUE);
  return texture;
}

}  // namespace

Status CardPainter::compile() {
  Result<Program> program = linkProgram("card_bake.vert", "card_bake.frag", {"BAKE"});
  if (!program) return program.error();
  Result<Program> store = linkCompute("card_store.comp");
  if (!store) return store.error();
  program_ = std::move(*program);
  store_ = std::move(*store);
  return ok();
}

void CardPainter::setMeshes(const LeafMeshBuffers& meshes, std::size_t layers) {
  release();
  array_ = meshes.makeArray();
  glEnableVertexArrayAttrib(array_.id(), 4);
  glVertexArrayAttribIFormat(array_.id(), 4, 1, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(array_.id(), 4, 2);
  glVertexArrayBindingDivisor(array_.id(), 2, 1);
  const auto first = meshes.commands().begin() + static_cast<std::ptrdiff_t>(kShape * layers);
  shapes_.assign(first, first + static_cast<std::ptrdiff_t>(layers));
}

void CardPainter::release() {
  for (Texture* texture : {&colours_, &surfaces_, &depth_}) texture->reset();
  for (Buffer* buffer : {&leaves_, &entries_, &tiles_, &places_, &commands_}) buffer->reset();
  framebuffer_.reset();
  pictures_ = {};
  begun_ = false;
}

Status CardPainter::begin(std::size_t number, const CardPlant& plant, float season) {
  const Error failed{"not enough graphics memory for the cards of leaves"};
  clearErrors();
  if (!framebuffer_) {
    colours_ = samplesOf(GL_RGBA16F);
    surfaces_ = samplesOf(GL_RGBA8);
    depth_ = samplesOf(GL_DEPTH_COMPONENT24);
    if (outOfMemory()) return failed;
    framebuffer_ = makeFramebuffer();
    glNamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, colours_.id(), 0);
    glNamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT1, surfaces_.id(), 0);
    glNamedFramebufferTexture(framebuffer_.id(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
    const GLenum targets[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(framebuffer_.id(), 2, targets);
    if (glCheckNamedFramebufferStatus(framebuffer_.id(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) return failed;
  }
  const std::size_t layers = plant.nodeCount * kCardViews;
  pictures_ = {};
  pictures_.colours = makeTextureArray(GL_SRGB8_ALPHA8, plant.tile, kLevels, layers);
  pictures_.surfaces = makeTextureArray(GL_RGBA8, plant.tile, kLevels, layers);
  if (outOfMemory()) return failed;
  GLuint view = 0;
  glGenTextures(1, &view);
  glTextureView(view, GL_TEXTURE_2D_ARRAY, pictures_.colours.id(), GL_RGBA8, 0, kLevels, 0,
                static_cast<GLuint>(layers));
  pictures_.colourBytes = Texture(view);
  pictures_.season = season;
  leaves_ = makeBuffer(static_cast<GLsizeiptr>(plant.leaves.size() * sizeof(LeafInstance)), plant.leaves.data(), 0);
  number_ = number;
  tile_ = plant.tile;
  next_ = 0;
  begun_ = true;
  return ok();
}

Result<bool> CardPainter::paint(std::size_t number, const CardPlant& plant, const std::vector<CardNode>& nodes,
                                float season, std::size_t leaves, CardPictures& done) {
  if (!begun_ || number_ != number || pictures_.season != season) {
    if (const Status status = begin(number, plant, season); !status) return status.error();
  }
  const std::size_t layers = plant.nodeCount * kCardViews;
  for (std::size_t painted = 0; next_ < layers && painted < leaves;) {
    painted += std::max<std::size_t>(1, paintPart(plant, nodes, leaves - painted));
  }
  if (next_ < layers) return false;
  done = std::move(pictures_);
  pictures_ = {};
  leaves_.reset();
  begun_ = false;
  return true;
}

std::size_t CardPainter::paintPart(const CardPlant& plant, const std::vector<CardNode>& nodes, std::size_t leaves) {
  const std::size_t across = static_cast<std::size_t>(kSide / tile_), first = next_;
  std::vector<CardTile> tiles;
  std::vector<std::vector<std::pair<GLuint, GLuint>>> ofLayer(shapes_.size());  // entry, tile
  std::size_t count = 0;
  for (; next_ < plant.nodeCount * kCardViews && tiles.size() < across * across && count < leaves; ++next_) {
    const std::size_t node = next_ / kCardViews;
    const auto number = static_cast<GLuint>(tiles.size());
    const float half = static_cast<float>(tile_) / kSide;
    const vec2 corner = vec2(number % across, number / across) * (2 * half) - 1.0f;
    tiles.push_back(
        {nodes[plant.firstNode + node].sphere, vec4(cardView(next_ % kCardViews), 0), vec4(corner + half, half, half)});
    const CardLeaves range = plant.ofNode[node];
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
      const std::size_t layer = std::min<std::size_t>(plant.leaves[i].layer, shapes_.size() - 1);
      ofLayer[layer].emplace_back(i | kWhole, number);
    }
    count += range.count;
  }
  std::vector<GLuint> entries, places;
  std::vector<DrawCommand> commands;
  for (std::size_t layer = 0; layer < ofLayer.size(); ++layer) {
    if (ofLayer[layer].empty()) continue;
    DrawCommand command = shapes_[layer];
    command.instances = static_cast<GLuint>(ofLayer[layer].size());
    command.baseInstance = static_cast<GLuint>(entries.size());
    commands.push_back(command);
    for (const auto& [entry, place] : ofLayer[layer]) entries.push_back(entry), places.push_back(place);
  }

  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, kSide, kSide);
  const float nothing[4]{}, farthest = 0;
  glClearNamedFramebufferfv(framebuffer_.id(), GL_COLOR, 0, nothing);
  glClearNamedFramebufferfv(framebuffer_.id(), GL_COLOR, 1, nothing);
  glClearNamedFramebufferfv(framebuffer_.id(), GL_DEPTH, 0, &farthest);
  if (!commands.empty()) {
    glDepthFunc(GL_GEQUAL);
    const auto bytes = [](const auto& of) { return static_cast<GLsizeiptr>(of.size() * sizeof(of[0])); };
    entries_ = makeBuffer(bytes(entries), entries.data(), 0);
    places_ = makeBuffer(bytes(places), places.data(), 0);
    commands_ = makeBuffer(bytes(commands), commands.data(), 0);
    tiles_ = makeBuffer(bytes(tiles), tiles.data(), 0);
    glUseProgram(program_.id());
    glUniform1f(1, pictures_.season);
    glBindVertexArray(array_.id());
    glVertexArrayVertexBuffer(array_.id(), 1, entries_.id(), 0, sizeof(GLuint));
    glVertexArrayVertexBuffer(array_.id(), 2, places_.id(), 0, sizeof(GLuint));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, leaves_.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 8, tiles_.id());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.id());
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(commands.size()), 0);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  store(first, tiles.size());
  return count;
}

void CardPainter::store(std::size_t firstLayer, std::size_t tiles) {
  glUseProgram(store_.id());
  glBindTextureUnit(6, colours_.id());
  glBindTextureUnit(7, surfaces_.id());
  for (int level = 0; level < kLevels; ++level) {
    glBindImageTexture(0, pictures_.colourBytes.id(), level, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA8);
    glBindImageTexture(1, pictures_.surfaces.id(), level, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA8);
    glUniform4i(0, tile_, kSide / tile_, level, static_cast<GLint>(firstLayer));
    const auto groups = static_cast<GLuint>(((tile_ >> level) + 7) / 8);
    glDispatchCompute(groups, groups, static_cast<GLuint>(tiles));
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace windfall::render
