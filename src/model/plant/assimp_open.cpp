#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <QFileInfo>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <new>
#include <stdexcept>

#include "model/plant/assimp_private.h"
#include "model/plant/fbx_check.h"
#include "model/plant/gltf_check.h"
#include "model/plant/hierarchy.h"

namespace Assimp {

[[noreturn]] void aiAssertViolation(const char* failedExpression, const char* file, int line);

/// Debian builds Assimp with its assertions on, so that a damaged file would end the whole program. The function that
/// they call is an exported one: this definition stands in for it, as one of operator new would. What it throws passes
/// through Assimp's frames as Assimp's own errors do.
void aiAssertViolation(const char* failedExpression, const char* /*file*/, int /*line*/) {
  throw std::runtime_error(std::string("it is damaged (") + failedExpression + ")");
}

}  // namespace Assimp

namespace windfall::model::assimp {

namespace {

constexpr const char* kNoMemory = "needs more memory than there is";

/// A source is bytes; whatever else a file names, on this disk or another, is not opened.
class NothingElse : public Assimp::IOSystem {
 public:
  bool Exists(const char*) const override { return false; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
  void Close(Assimp::IOStream*) override {}
};

/// Reading is half of the work.
class Reporter : public Assimp::ProgressHandler {
 public:
  explicit Reporter(Progress& progress) : progress_(progress) {}
  bool Update(float fraction) override {
    if (fraction >= 0) progress_.report(0.5 * static_cast<double>(fraction));
    return !progress_.cancelled();
  }

 private:
  Progress& progress_;
};

/// "FBX-Tokenize (offset 0x1ef) block offset is out of range": one line, without Assimp's own prefixes of place.
std::string oneLine(const char* message) {
  const QString line = QString::fromUtf8(message).simplified();
  return line.isEmpty() ? std::string("cannot be read") : "cannot be read: " + line.toStdString();
}

/// What Assimp itself does not look at before it trusts it. Levels of nodes.
Result<int> lookThrough(const QByteArray& bytes, const QString& extension) {
  if (bytes.isEmpty()) return Error{"is empty"};
  if (extension == QLatin1String("glb")) return checkGltf(bytes, true);
  if (extension == QLatin1String("gltf")) return checkGltf(bytes, false);
  return extension == QLatin1String("fbx") ? checkFbx(bytes) : Result<int>(1);
}

Status read(const SourceFile& file, Progress& progress, const std::function<Status(const aiScene&)>& use) {
  try {
    Assimp::Importer importer;
    importer.SetIOHandler(new NothingElse);
    importer.SetProgressHandler(new Reporter(progress));
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, true);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const aiScene* scene = importer.ReadFileFromMemory(
        file.bytes.constData(), static_cast<std::size_t>(file.bytes.size()),
        aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType, qPrintable(extensionOf(file)));
    if (progress.cancelled()) return Error{"cancelled", true};
    if (scene == nullptr) return Error{oneLine(importer.GetErrorString())};
    return use(*scene);
  } catch (const std::bad_alloc&) {
    return Error{kNoMemory};
  } catch (const std::exception& problem) {
    return Error{oneLine(problem.what())};
  }
}

}  // namespace

QString extensionOf(const SourceFile& file) { return QFileInfo(file.name).suffix().toLower(); }

Status withScene(const SourceFile& file, Progress& progress, const std::function<Status(const aiScene&)>& use) {
  const Result<int> levels = lookThrough(file.bytes, extensionOf(file));
  if (!levels) return levels.error();
  Status status = Error{kNoMemory};
  runWithDeepStack(*levels, [&] { status = read(file, progress, use); });
  return status;
}

}  // namespace windfall::model::assimp
