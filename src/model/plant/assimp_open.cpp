#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <QFileInfo>
#include <assimp/IOSystem.hpp>
#include <assimp/ProgressHandler.hpp>

#include "model/plant/assimp_private.h"
#include "model/plant/gltf_check.h"

namespace windfall::model::assimp {

namespace {

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

}  // namespace

/// "FBX-Tokenize (offset 0x1ef) block offset is out of range": one line, without Assimp's own prefixes of place.
std::string oneLine(const char* message) {
  QString line = QString::fromUtf8(message).simplified();
  return line.isEmpty() ? std::string("cannot be read") : "cannot be read: " + line.toStdString();
}

QString extensionOf(const SourceFile& file) { return QFileInfo(file.name).suffix().toLower(); }

Result<const aiScene*> openScene(Assimp::Importer& importer, const SourceFile& file, Progress& progress) {
  const QString extension = extensionOf(file);
  if (file.bytes.isEmpty()) return Error{"is empty"};
  if (extension == QLatin1String("glb") || extension == QLatin1String("gltf")) {
    if (const Status status = checkGltf(file.bytes, extension == QLatin1String("glb")); !status) return status.error();
  }
  importer.SetIOHandler(new NothingElse);
  importer.SetProgressHandler(new Reporter(progress));
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFileFromMemory(
      file.bytes.constData(), static_cast<std::size_t>(file.bytes.size()),
      aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType, qPrintable(extension));
  if (progress.cancelled()) return Error{"cancelled", true};
  if (scene == nullptr) return Error{oneLine(importer.GetErrorString())};
  return scene;
}

}  // namespace windfall::model::assimp
