#include "widgets/render/offscreen_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "widgets/render/gl_object.h"
#include "widgets/render/gl_version.h"

namespace windfall::render {

struct OffscreenContext::Impl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  Framebuffer framebuffer;
  Texture color;
  int width = 0, height = 0;

  ~Impl() {
    if (context != EGL_NO_CONTEXT) {
      framebuffer.reset();
      color.reset();
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      eglDestroyContext(display, context);
    }
    if (display != EGL_NO_DISPLAY) eglTerminate(display);
  }

  /// Version 4.5, or else whatever there is, so that the error can name it.
  bool start(EGLDisplay on) {
    EGLint major = 0, minor = 0;
    if (on == EGL_NO_DISPLAY || eglInitialize(on, &major, &minor) != EGL_TRUE) return false;
    display = on;
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return false;
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display, wanted, &config, 1, &count) != EGL_TRUE || count == 0) config = EGL_NO_CONFIG_KHR;
    for (const bool newest : {true, false}) {
      const EGLint version[] = {
          EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
          EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
      const EGLint any[] = {EGL_NONE};
      context = eglCreateContext(display, config, EGL_NO_CONTEXT, newest ? version : any);
      if (context != EGL_NO_CONTEXT) break;
    }
    return context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE;
  }
};

namespace {

EGLDisplay surfacelessDisplay() {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (extensions == nullptr || std::strstr(extensions, "EGL_MESA_platform_surfaceless") == nullptr)
    return EGL_NO_DISPLAY;
  return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
}

}  // namespace

OffscreenContext::OffscreenContext() : impl_(std::make_unique<Impl>()) {}
OffscreenContext::~OffscreenContext() = default;

Result<std::unique_ptr<OffscreenContext>> OffscreenContext::create(int width, int height) {
  std::unique_ptr<OffscreenContext> made(new OffscreenContext);
  if (!made->impl_->start(surfacelessDisplay())) {
    made->impl_ = std::make_unique<Impl>();
    if (!made->impl_->start(eglGetDisplay(EGL_DEFAULT_DISPLAY))) {
      return Error{"needs OpenGL 4.5; this machine offers no OpenGL without a window (EGL)"};
    }
  }
  if (const Status version = checkVersion(); !version) return version.error();
  if (const Status sized = made->resize(width, height); !sized) return sized.error();
  return made;
}

Status OffscreenContext::resize(int width, int height) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (width < 1 || height < 1 || width > largest || height > largest) {
    return Error{"a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                 " pixels is not possible here; the largest side is " + std::to_string(largest)};
  }
  clearErrors();
  Texture color = makeTexture(GL_TEXTURE_2D);
  glTextureStorage2D(color.id(), 1, GL_RGBA8, width, height);
  if (outOfMemory()) return Error{"not enough graphics memory for a picture of that size"};
  Framebuffer framebuffer = makeFramebuffer();
  glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, color.id(), 0);
  impl_->color = std::move(color);
  impl_->framebuffer = std::move(framebuffer);
  impl_->width = width;
  impl_->height = height;
  return ok();
}

unsigned OffscreenContext::framebuffer() const { return impl_->framebuffer.id(); }

Picture OffscreenContext::read() const {
  Picture picture;
  picture.width = impl_->width;
  picture.height = impl_->height;
  const std::size_t row = static_cast<std::size_t>(picture.width) * 4;
  picture.rgba.resize(row * static_cast<std::size_t>(picture.height));
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glGetTextureImage(impl_->color.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(picture.rgba.size()),
                    picture.rgba.data());
  for (int y = 0; y < picture.height / 2; ++y) {
    std::swap_ranges(picture.rgba.begin() + static_cast<std::ptrdiff_t>(row) * y,
                     picture.rgba.begin() + static_cast<std::ptrdiff_t>(row) * (y + 1),
                     picture.rgba.end() - static_cast<std::ptrdiff_t>(row) * (y + 1));
  }
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) picture.rgba[i] = 255;
  return picture;
}

}  // namespace windfall::render
