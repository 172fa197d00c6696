// Shader errors name file and line; a machine without OpenGL 4.5 gets one clear line.
#include <doctest/doctest.h>

#include <cstdlib>

#include "support/render_stage.h"
#include "widgets/render/embedded_text.h"
#include "widgets/render/shader_program.h"

using namespace windfall;

TEST_CASE("a shader's error names the file and the line") {
  test::Stage stage(16, 16);
  WINDFALL_NEEDS_OPENGL(stage);
  const auto broken =
      render::compileShader(GL_FRAGMENT_SHADER, "broken.frag",
                            "#include \"frame.glsl\"\nout vec4 color;\nvoid main() {\n  color = nothing;\n}\n", {});
  REQUIRE_FALSE(bool(broken));
  const std::string& message = broken.error().message;
  CAPTURE(message);
  CHECK(message.find("shader broken.frag:4: ") == 0);
  CHECK(message.find("nothing") != std::string::npos);
  CHECK(message.find('\n') == std::string::npos);
}

TEST_CASE("a shader that is not there is named") {
  test::Stage stage(16, 16);
  WINDFALL_NEEDS_OPENGL(stage);
  const auto missing = render::linkProgram("absent.vert", "sky.frag");
  REQUIRE_FALSE(bool(missing));
  CHECK(missing.error().message == "shader absent.vert is missing");
  CHECK(render::embeddedText("absent.vert").empty());
  CHECK_FALSE(render::embeddedText("sky.frag").empty());
}

TEST_CASE("less than OpenGL 4.5 is one clear line") {
  const char* before = std::getenv("MESA_GL_VERSION_OVERRIDE");
  const std::string kept = before != nullptr ? before : "";
  setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
  const auto context = render::OffscreenContext::create(16, 16);
  if (before != nullptr) {
    setenv("MESA_GL_VERSION_OVERRIDE", kept.c_str(), 1);
  } else {
    unsetenv("MESA_GL_VERSION_OVERRIDE");
  }
  if (context) {
    MESSAGE("skipped: this driver's version cannot be lowered");
    return;
  }
  const std::string& message = context.error().message;
  CAPTURE(message);
  CHECK(message.find("needs OpenGL 4.5; this machine offers ") == 0);
  CHECK(message.find('\n') == std::string::npos);
}
