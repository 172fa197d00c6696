#include "widgets/render/tree_pass.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "widgets/render/mip_chain.h"
#include "widgets/render/shader_program.h"

namespace windfall::render {

namespace {

constexpr int kLargestPicture = 2048;
constexpr float kBarkRelief = 0.012f;  // m

Error mismatch(std::size_t mesh, const std::string& what) {
  return Error{"mesh " + std::to_string(mesh + 1) + ": " + what};
}

/// What the GPU would read out of bounds is refused here.
Status check(const SceneContent& content) {
  for (std::size_t m = 0; m < content.meshes.size(); ++m) {
    const Mesh& mesh = content.meshes[m];
    for (const std::uint32_t index : mesh.indices) {
      if (index >= mesh.vertices.size()) return mismatch(m, "an index names a vertex that is not there");
    }
    for (const Part& part : mesh.parts) {
      if (part.firstIndex > mesh.indices.size() || part.indexCount > mesh.indices.size() - part.firstIndex) {
        return mismatch(m, "a part names indices that are not there");
      }
      if (part.material < 0 || part.material >= static_cast<int>(mesh.materials.size())) {
        return mismatch(m, "a part names a material that is not there");
      }
    }
    for (const Material& material : mesh.materials) {
      if (material.picture >= static_cast<int>(mesh.pictures.size())) {
        return mismatch(m, "a material names a picture that is not there");
      }
    }
    for (const Picture& picture : mesh.pictures) {
      if (picture.width < 1 || picture.height < 1 ||
          picture.rgba.size() !=
              static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * 4) {
        return mismatch(m, "a picture is empty or its size is wrong");
      }
    }
  }
  for (const TreeDraw& tree : content.trees) {
    if (tree.mesh < 0 || tree.mesh >= static_cast<int>(content.meshes.size())) {
      return Error{"a tree names a mesh that is not there"};
    }
    if (tree.firstLink > content.linkCount || tree.linkCount > content.linkCount - tree.firstLink) {
      return Error{"a tree names links that are not there"};
    }
    for (const Vertex& vertex : content.meshes[static_cast<std::size_t>(tree.mesh)].vertices) {
      for (const std::uint32_t link : vertex.links) {
        if (link >= tree.linkCount)
          return mismatch(static_cast<std::size_t>(tree.mesh), "a vertex names a link that is not there");
      }
    }
  }
  return ok();
}

int powerOfTwo(int size) {
  int power = 1;
  while (power < size && power < kLargestPicture) power *= 2;
  return power;
}

Texture uploadPicture(const Picture& picture, bool cutOut) {
  const auto levels = mipChain(picture, powerOfTwo(picture.width), powerOfTwo(picture.height), cutOut);
  Texture texture = makeTexture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.id(), static_cast<GLsizei>(levels.size()), GL_SRGB8_ALPHA8, levels[0].width,
                     levels[0].height);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    glTextureSubImage2D(texture.id(), static_cast<GLint>(i), 0, 0, levels[i].width, levels[i].height, GL_RGBA,
                        GL_UNSIGNED_BYTE, levels[i].rgba.data());
  }
  glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  return texture;
}

void attribute(GLuint array, GLuint location, GLint count, GLenum type, std::size_t offset) {
  glEnableVertexArrayAttrib(array, location);
  if (type == GL_UNSIGNED_INT) {
    glVertexArrayAttribIFormat(array, location, count, type, static_cast<GLuint>(offset));
  } else {
    const GLboolean normalized = type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE;
    glVertexArrayAttribFormat(array, location, count, type, normalized, static_cast<GLuint>(offset));
  }
  glVertexArrayAttribBinding(array, location, 0);
}

/// The outline of each ring.
void addRings(const DetailMesh& detail, Bounds& bounds) {
  for (const DetailRing& ring : detail.rings) {
    const vec3 reach = ring.radius * glm::sqrt(glm::max(vec3(1) - ring.tangent * ring.tangent, vec3(0)));
    bounds.add(ring.position - reach);
    bounds.add(ring.position + reach);
  }
}

const void* indexOffset(std::uint32_t first) {
  return reinterpret_cast<const void*>(first * sizeof(std::uint32_t));  // NOLINT: an offset, as OpenGL wants
}

}  // namespace

void Bounds::add(const vec3& point) {
  lower = glm::min(lower, point);
  upper = glm::max(upper, point);
}

Status TreePass::compile() {
  const auto link = [](Program& into, const std::string& name, const std::vector<std::string>& defines) -> Status {
    Result<Program> linked = linkProgram(name + ".vert", name + ".frag", defines);
    if (!linked) return linked.error();
    into = std::move(*linked);
    return ok();
  };
  for (const Status& status :
       {link(wood_[0][0], "tree", {"BARE"}), link(wood_[1][0], "tree", {"HIGH_QUALITY", "BARE"}),
        link(wood_[0][1], "tree", {"PICTURED"}), link(wood_[1][1], "tree", {"HIGH_QUALITY", "PICTURED"}),
        link(foliage_[0], "tree", {"FOLIAGE"}), link(foliage_[1], "tree", {"FOLIAGE", "HIGH_QUALITY"}),
        link(pieces_[0], "tree", {"BARE", "PIECES"}), link(pieces_[1], "tree", {"HIGH_QUALITY", "BARE", "PIECES"}),
        link(shadow_, "tree_shadow", {}), link(pieceShadow_, "tree_shadow", {"PIECES"})}) {
    if (!status) return status;
  }
  return ok();
}

Status TreePass::setContent(const SceneContent& content) {
  meshes_.clear();
  trees_.clear();
  if (const Status sound = check(content); !sound) return sound;
  std::vector<GpuMesh> meshes(content.meshes.size());
  for (std::size_t m = 0; m < content.meshes.size(); ++m) {
    std::vector<std::uint32_t> firstLinks;
    for (const TreeDraw& tree : content.trees) {
      if (tree.mesh == static_cast<int>(m)) firstLinks.push_back(tree.firstLink);
    }
    if (firstLinks.empty() || content.meshes[m].vertices.empty() || content.meshes[m].indices.empty()) continue;
    if (const Status uploaded = upload(content.meshes[m], firstLinks, meshes[m]); !uploaded) return uploaded;
  }
  bool needsAdaptive = false;
  for (const TreeDraw& tree : content.trees) {
    GpuMesh& mesh = meshes[static_cast<std::size_t>(tree.mesh)];
    if (mesh.detailed || tree.detail < 0 || tree.detail >= static_cast<int>(content.details.size())) continue;
    mesh.detailed = true;
    addRings(*content.details[static_cast<std::size_t>(tree.detail)], mesh.bounds);
    for (const Part& part : content.meshes[static_cast<std::size_t>(tree.mesh)].parts) {
      needsAdaptive = needsAdaptive || (part.adaptive && part.indexCount == 0);
    }
  }
  needsAdaptive_ = needsAdaptive;
  meshes_ = std::move(meshes);
  trees_ = content.trees;
  return ok();
}

Status TreePass::upload(const Mesh& mesh, const std::vector<std::uint32_t>& firstLinks, GpuMesh& out) {
  clearErrors();
  const auto bytes = [](const auto& values) { return static_cast<GLsizeiptr>(values.size() * sizeof(values[0])); };
  out.vertices = makeBuffer(bytes(mesh.vertices), mesh.vertices.data(), 0);
  out.indices = makeBuffer(bytes(mesh.indices), mesh.indices.data(), 0);
  out.instances = makeBuffer(bytes(firstLinks), firstLinks.data(), 0);
  out.array = makeVertexArray();
  const GLuint array = out.array.id();
  glVertexArrayVertexBuffer(array, 0, out.vertices.id(), 0, sizeof(Vertex));
  glVertexArrayVertexBuffer(array, 1, out.instances.id(), 0, sizeof(std::uint32_t));
  glVertexArrayElementBuffer(array, out.indices.id());
  attribute(array, 0, 3, GL_FLOAT, offsetof(Vertex, position));
  attribute(array, 1, 3, GL_FLOAT, offsetof(Vertex, normal));
  attribute(array, 2, 2, GL_FLOAT, offsetof(Vertex, uv));
  attribute(array, 3, 4, GL_UNSIGNED_INT, offsetof(Vertex, links));
  attribute(array, 4, 4, GL_FLOAT, offsetof(Vertex, weights));
  attribute(array, 6, 1, GL_FLOAT, offsetof(Vertex, repeats));
  attribute(array, 7, 4, GL_UNSIGNED_BYTE, offsetof(Vertex, tint));
  attribute(array, 5, 1, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(array, 5, 1);
  glVertexArrayBindingDivisor(array, 1, 1);

  for (std::size_t p = 0; p < mesh.pictures.size(); ++p) {
    const bool used = std::any_of(mesh.parts.begin(), mesh.parts.end(), [&](const Part& part) {
      return part.indexCount > 0 &&
             mesh.materials[static_cast<std::size_t>(part.material)].picture == static_cast<int>(p);
    });
    // An adaptive mesh has its own copy.
    if (!used) {
      out.pictures.emplace_back();
      continue;
    }
    const bool cutOut = std::any_of(mesh.materials.begin(), mesh.materials.end(), [&](const Material& material) {
      return material.foliage && material.picture == static_cast<int>(p);
    });
    out.pictures.push_back(uploadPicture(mesh.pictures[p], cutOut));
  }
  out.parts = mesh.parts;
  out.materials = mesh.materials;
  out.instanceCount = static_cast<GLsizei>(firstLinks.size());
  for (const Vertex& vertex : mesh.vertices) out.bounds.add(vertex.position);
  const float reach = glm::length(glm::max(glm::abs(out.bounds.lower), glm::abs(out.bounds.upper)));
  for (const Part& part : mesh.parts) {
    out.pieces.emplace_back();
    if (part.pieces > 0 && part.indexCount > 0 && mesh.materials[static_cast<std::size_t>(part.material)].picture < 0) {
      out.pieces.back().emplace(part, mesh.indices, firstLinks, reach);
    }
  }
  if (outOfMemory()) return Error{"not enough graphics memory for a tree's mesh and pictures"};
  return ok();
}

int TreePass::draw(bool highQuality, bool adaptive, const PieceSight& sight, std::span<const mat4> bones) {
  int calls = 0;
  const std::size_t quality = highQuality ? 1 : 0;
  for (GpuMesh& mesh : meshes_) {
    if (mesh.instanceCount == 0) continue;
    glBindVertexArray(mesh.array.id());
    for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
      const Part& part = mesh.parts[p];
      if (part.indexCount == 0 || (adaptive && mesh.detailed && part.adaptive)) continue;
      const Material& material = mesh.materials[static_cast<std::size_t>(part.material)];
      const bool pictured = material.picture >= 0;
      const bool scattered = mesh.pieces[p].has_value();
      glUseProgram((scattered          ? pieces_[quality]
                    : material.foliage ? foliage_[quality]
                                       : wood_[quality][pictured ? 1 : 0])
                       .id());
      if (pictured) glBindTextureUnit(3, mesh.pictures[static_cast<std::size_t>(material.picture)].id());
      glUniform4fv(0, 1, glm::value_ptr(material.baseColor));
      glUniform4f(1, material.roughness, pictured ? 1.f : 0.f, 0.f, kBarkRelief);
      if (material.foliage) {
        glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
      } else {
        glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
      }
      // What was made from a skeleton is closed.
      (part.adaptive ? glEnable : glDisable)(GL_CULL_FACE);
      calls += drawPart(mesh, p, sight, bones);
    }
  }
  glDisable(GL_CULL_FACE);
  glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  return calls;
}

int TreePass::drawPart(GpuMesh& mesh, std::size_t index, const PieceSight& sight, std::span<const mat4> bones) {
  if (mesh.pieces[index]) return mesh.pieces[index]->draw(sight, bones) ? 1 : 0;
  const Part& part = mesh.parts[index];
  glDrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(part.indexCount), GL_UNSIGNED_INT,
                          indexOffset(part.firstIndex), mesh.instanceCount);
  return 1;
}

int TreePass::drawShadow(const mat4& lightMatrix, bool adaptive, const PieceSight& sight, std::span<const mat4> bones) {
  int calls = 0;
  for (const Program* program : {&shadow_, &pieceShadow_}) {
    glProgramUniformMatrix4fv(program->id(), 0, 1, GL_FALSE, glm::value_ptr(lightMatrix));
  }
  for (GpuMesh& mesh : meshes_) {
    if (mesh.instanceCount == 0) continue;
    glBindVertexArray(mesh.array.id());
    for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
      const Part& part = mesh.parts[p];
      if (part.indexCount == 0 || (adaptive && mesh.detailed && part.adaptive)) continue;
      const Material& material = mesh.materials[static_cast<std::size_t>(part.material)];
      const bool tested = material.foliage && material.picture >= 0;
      if (tested) glBindTextureUnit(3, mesh.pictures[static_cast<std::size_t>(material.picture)].id());
      glUseProgram((mesh.pieces[p] ? pieceShadow_ : shadow_).id());
      glUniform1f(1, tested ? 1.f : 0.f);
      calls += drawPart(mesh, p, sight, bones);
    }
  }
  return calls;
}

}  // namespace windfall::render
