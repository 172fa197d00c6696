#include "widgets/render/gl_version.h"

#include <epoxy/gl.h>

namespace windfall::render {

std::string deviceName() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name != nullptr ? name : "unknown device";
}

Status checkVersion() {
  const int version = epoxy_is_desktop_gl() ? epoxy_gl_version() : 0;
  if (version >= 45) return ok();
  const std::string offered =
      version == 0 ? "OpenGL ES" : std::to_string(version / 10) + "." + std::to_string(version % 10);
  return Error{"needs OpenGL 4.5; this machine offers " + offered + " (" + deviceName() + ")"};
}

bool isSoftware() {
  const std::string name = deviceName();
  return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos ||
         name.find("SwiftShader") != std::string::npos;
}

}  // namespace windfall::render
