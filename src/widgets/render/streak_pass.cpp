#include "widgets/render/streak_pass.h"

#include "widgets/render/shader_program.h"

namespace windfall::render {

Status StreakPass::compile() {
  Result<Program> linked = linkProgram("streak.vert", "streak.frag", {"STANDARD_QUALITY"});
  if (!linked) return linked.error();
  program_ = std::move(*linked);
  return ok();
}

int StreakPass::draw(const std::vector<vec4>& points, int perStreak) {
  if (points.empty() || perStreak < 2) return 0;
  const auto bytes = static_cast<GLsizeiptr>(points.size() * sizeof(vec4));
  if (points.size() > capacity_) {
    points_ = makeBuffer(bytes, nullptr, GL_DYNAMIC_STORAGE_BIT);
    capacity_ = points.size();
  }
  glNamedBufferSubData(points_.id(), 0, bytes, points.data());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, points_.id());
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  glDepthMask(GL_FALSE);
  glUseProgram(program_.id());
  glUniform1i(0, perStreak);
  const auto streaks = static_cast<GLsizei>(points.size()) / perStreak;
  glDrawArrays(GL_TRIANGLES, 0, streaks * (perStreak - 1) * 6);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ZERO);
  return 1;
}

}  // namespace windfall::render
