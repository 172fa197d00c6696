#include "widgets/render/shader_program.h"

#include <cstring>
#include <regex>
#include <sstream>

#include "widgets/render/embedded_text.h"

namespace windfall::render {

namespace {

/// The whole text with includes replaced; source-string numbers in #line say which file a line is of.
struct Expanded {
  std::string text;
  std::vector<std::string> files;
};

void expand(const std::string& name, const std::string& text, Expanded& out) {
  const std::size_t number = out.files.size();
  out.files.push_back(name);
  out.text += "#line 1 " + std::to_string(number) + "\n";
  std::istringstream lines(text);
  std::string line;
  for (int at = 1; std::getline(lines, line); ++at) {
    if (line.rfind("#include \"", 0) == 0) {
      const std::string included = line.substr(10, line.find('"', 10) - 10);
      expand(included, std::string(embeddedText(included)), out);
      out.text += "#line " + std::to_string(at + 1) + " " + std::to_string(number) + "\n";
    } else {
      out.text += line + "\n";
    }
  }
}

/// "0:12(3): error: …" and "0(12) : error …" as "file:12: …", the first line that says so.
std::string readable(const std::string& log, const Expanded& source) {
  static const std::regex place(R"((\d+)[:(](\d+)[^:]*:\s*(.*))");
  std::istringstream lines(log);
  std::string line;
  while (std::getline(lines, line)) {
    std::smatch match;
    if (!std::regex_search(line, match, place)) continue;
    const std::size_t file = std::stoul(match[1]);
    if (file >= source.files.size()) continue;
    return source.files[file] + ":" + match[2].str() + ": " + match[3].str();
  }
  return source.files.front() + ": " + log.substr(0, log.find('\n'));
}

}  // namespace

Result<Shader> compileShader(GLenum stage, const std::string& name, const std::string& text,
                             const std::vector<std::string>& defines) {
  Expanded source;
  source.text = "#version 450 core\n";
  for (const std::string& define : defines) source.text += "#define " + define + "\n";
  expand(name, text, source);
  Shader shader(glCreateShader(stage));
  const char* begin = source.text.c_str();
  glShaderSource(shader.id(), 1, &begin, nullptr);
  glCompileShader(shader.id());
  GLint good = 0;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  GLint length = 0;
  glGetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length) + 1, '\0');
  glGetShaderInfoLog(shader.id(), length, nullptr, log.data());
  log.resize(std::strlen(log.data()));
  return Error{"shader " + readable(log, source)};
}

namespace {

using Stages = std::vector<std::pair<GLenum, std::string>>;

Result<Program> linkStages(const Stages& stages, const std::vector<std::string>& defines) {
  Program program(glCreateProgram());
  std::string names;
  for (const auto& [stage, name] : stages) {
    if (name.empty()) continue;
    names += (names.empty() ? "" : " and ") + name;
    const std::string_view text = embeddedText(name);
    if (text.empty()) return Error{"shader " + name + " is missing"};
    Result<Shader> shader = compileShader(stage, name, std::string(text), defines);
    if (!shader) return shader.error();
    glAttachShader(program.id(), shader->id());
  }
  glLinkProgram(program.id());
  GLint good = 0;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &good);
  if (good == GL_TRUE) return program;
  char log[512] = {};
  glGetProgramInfoLog(program.id(), sizeof log - 1, nullptr, log);
  return Error{"shaders " + names + ": " + std::string(log).substr(0, std::string(log).find('\n'))};
}

}  // namespace

Result<Program> linkProgram(const std::string& vertex, const std::string& fragment,
                            const std::vector<std::string>& defines) {
  return linkStages({{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}}, defines);
}

Result<Program> linkCompute(const std::string& name, const std::vector<std::string>& defines) {
  return linkStages({{GL_COMPUTE_SHADER, name}}, defines);
}

}  // namespace windfall::render
