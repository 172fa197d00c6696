#include "model/plant/import_repair.h"

#include <QRegularExpression>
#include <algorithm>
#include <cmath>
#include <set>

#include "model/plant/links_private.h"

namespace windfall::model {

namespace {

constexpr std::size_t kMostBones = 1'000'000;
constexpr float kShortest = 1e-5f;  // m

QString counted(qsizetype count, const char* one, const char* many) {
  return count == 1 ? QString::fromLatin1(one) : QString::fromLatin1(many).arg(count);
}

/// Names that only the skeleton of a person or an animal has; "arm" and "leg" alone would meet "armature" and "legno".
bool isOfFigure(const QString& name) {
  static const QRegularExpression figure(
      QStringLiteral(
          "(^|[_:. ]|mixamorig:?)(hips?|pelvis|spine\\d*|neck|head|clavicle|shoulder|upperarm|forearm|hand|thigh|"
          "shin|calf|foot|toe(base)?|(left|right)(arm|leg|foot|hand|upleg))([_:. \\d]|$)"),
      QRegularExpression::CaseInsensitiveOption);
  return figure.match(name).hasMatch();
}

}  // namespace

Status checkSkeleton(const PlantGeometry& geometry) {
  const std::vector<Bone>& bones = geometry.bones;
  if (bones.size() > kMostBones) return Error{"has more than a million bones"};
  std::set<QString> parts;
  for (const Bone& bone : bones) {
    if (isOfFigure(bone.name)) parts.insert(bone.name);
  }
  // A wooden figure or two may carry such a name; a whole body is no tree.
  if (parts.size() >= 5 && parts.size() * 4 >= std::min<std::size_t>(bones.size(), 60)) {
    return Error{"is the skeleton of a figure (" + parts.begin()->toStdString() + ", " +
                 std::next(parts.begin())->toStdString() + ", …), not of a tree"};
  }
  const bool apart = std::any_of(bones.begin(), bones.end(), [&](const Bone& bone) {
    return glm::length(bone.head - bones.front().head) > kShortest;
  });
  vec3 lower(1e30f), upper(-1e30f);
  for (const Vertex& vertex : geometry.vertices) {
    lower = glm::min(lower, vertex.position);
    upper = glm::max(upper, vertex.position);
  }
  if (bones.size() > 2 && !apart) return Error{"has all its bones in one place: they do not follow the tree"};
  if (!(glm::length(upper - lower) > 1e-4f)) return Error{"has a mesh without size"};
  return ok();
}

void mendBones(PlantGeometry& geometry) {
  std::vector<Bone>& bones = geometry.bones;
  qsizetype short_ = 0, thin = 0, roots = 0, idle = 0;
  for (Bone& bone : bones) {
    const auto finite = [](const vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
    if (!finite(bone.tail)) bone.tail = bone.head;
    const float length = glm::length(bone.tail - bone.head);
    if (!(bone.radius > 0) || !std::isfinite(bone.radius)) {
      bone.radius = bone.parent >= 0 ? 0.7f * bones[static_cast<std::size_t>(bone.parent)].radius : 0.05f * length;
      if (!(bone.radius > 0)) bone.radius = 1e-3f;
      ++thin;
    }
    if (bone.weighted && !bends(bone)) ++short_;
    if (bone.parent < 0 && bone.weighted) ++roots;
    if (!bone.weighted) ++idle;
  }
  if (short_ > 0) {
    geometry.notes << counted(short_, "one bone is too short to bend and moves with its parent",
                              "%1 bones are too short to bend and move with their parents");
  }
  if (thin > 0) {
    geometry.notes << counted(thin, "one bone has no thickness and takes that of its parent",
                              "%1 bones have no thickness and take that of their parents");
  }
  if (idle > 0) {
    geometry.notes << counted(idle, "one bone moves no vertex", "%1 bones move no vertex");
  }
  if (roots > 1) geometry.notes << QStringLiteral("its %1 roots stand side by side").arg(roots);
}

}  // namespace windfall::model
