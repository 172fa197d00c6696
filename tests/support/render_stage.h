// A context without a window and a renderer in it, for the renderer's tests.
#pragma once

#include <doctest/doctest.h>

#include <memory>
#include <string>

#include "support/render_scene.h"
#include "widgets/render/offscreen_context.h"
#include "widgets/render/renderer.h"

namespace windfall::test {

struct Stage {
  std::unique_ptr<render::OffscreenContext> context;
  std::unique_ptr<render::Renderer> renderer;
  std::string problem;  ///< why there is no OpenGL 4.5 here

  Stage(int width, int height) {
    auto made = render::OffscreenContext::create(width, height);
    if (!made) {
      problem = made.error().message;
      return;
    }
    context = std::move(*made);
    auto drawn = render::Renderer::create();
    REQUIRE_MESSAGE(bool(drawn), drawn.error().message);
    renderer = std::move(*drawn);
    view.width = width;
    view.height = height;
    view.quality = render::Quality::Draft;
  }
  ~Stage() { renderer.reset(); }

  render::View view;

  void setContent(const render::SceneContent& content) {
    const Status status = renderer->setContent(content);
    REQUIRE_MESSAGE(bool(status), status.error().message);
  }
  render::Picture draw() {
    const Status status = renderer->draw(view, context->framebuffer());
    REQUIRE_MESSAGE(bool(status), status.error().message);
    return context->read();
  }
};

/// Keeps the picture of a failed check for whoever mends it.
inline void keep(const render::Picture& picture, const std::string& name) {
  writePicture(picture, std::string(WINDFALL_TEST_OUTPUT) + "/" + name + ".ppm");
}

}  // namespace windfall::test

/// Ends the test, by name, where this machine offers no OpenGL 4.5.
#define WINDFALL_NEEDS_OPENGL(stage)         \
  if (!(stage).renderer) {                   \
    MESSAGE("skipped: " << (stage).problem); \
    return;                                  \
  }
