// OpenGL names that are deleted with their owner. The context must be current then.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace windfall::render {

/// A move-only OpenGL name; Traits says how it is deleted.
template <class Traits>
class GlObject {
 public:
  GlObject() = default;
  explicit GlObject(GLuint id) : id_(id) {}
  ~GlObject() { reset(); }
  GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  GLuint id() const { return id_; }
  explicit operator bool() const { return id_ != 0; }
  void reset() {
    if (id_ != 0) Traits::destroy(id_);
    id_ = 0;
  }

 private:
  GLuint id_ = 0;
};

struct BufferTraits {
  static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
};
struct TextureTraits {
  static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};
struct VertexArrayTraits {
  static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
};
struct FramebufferTraits {
  static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
};
struct ProgramTraits {
  static void destroy(GLuint id) { glDeleteProgram(id); }
};
struct ShaderTraits {
  static void destroy(GLuint id) { glDeleteShader(id); }
};

using Buffer = GlObject<BufferTraits>;
using Texture = GlObject<TextureTraits>;
using VertexArray = GlObject<VertexArrayTraits>;
using Framebuffer = GlObject<FramebufferTraits>;
using Program = GlObject<ProgramTraits>;
using Shader = GlObject<ShaderTraits>;

inline Buffer makeBuffer(GLsizeiptr bytes, const void* data, GLbitfield flags) {
  GLuint id = 0;
  glCreateBuffers(1, &id);
  glNamedBufferStorage(id, bytes, data, flags);
  return Buffer(id);
}
inline Texture makeTexture(GLenum target) {
  GLuint id = 0;
  glCreateTextures(target, 1, &id);
  return Texture(id);
}
/// Square layers with `levels` mipmaps, filtered between them, the rim repeated beyond it.
inline Texture makeTextureArray(GLenum format, int side, int levels, std::size_t layers) {
  Texture array = makeTexture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(array.id(), levels, format, side, side, static_cast<GLsizei>(layers));
  glTextureParameteri(array.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(array.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(array.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return array;
}
inline VertexArray makeVertexArray() {
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  return VertexArray(id);
}
inline Framebuffer makeFramebuffer() {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  return Framebuffer(id);
}

/// Forgets errors of earlier calls.
inline void clearErrors() {
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
  }
}
/// True where OpenGL ran out of memory since clearErrors.
inline bool outOfMemory() {
  bool out = false;
  for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) {
    out = out || error == GL_OUT_OF_MEMORY;
    if (error == GL_CONTEXT_LOST) break;
  }
  return out;
}

}  // namespace windfall::render
