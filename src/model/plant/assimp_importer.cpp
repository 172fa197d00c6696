#include "model/plant/assimp_importer.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <QFileInfo>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <new>

#include "model/plant/assimp_private.h"
#include "model/plant/foliage.h"
#include "model/plant/gltf_check.h"
#include "model/plant/import_repair.h"
#include "model/plant/skeleton_geometry.h"

namespace windfall::model {

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

/// "FBX-Tokenize (offset 0x1ef) block offset is out of range": one line, without Assimp's own prefixes of place.
std::string oneLine(const char* message) {
  QString line = QString::fromUtf8(message).simplified();
  return line.isEmpty() ? std::string("cannot be read") : "cannot be read: " + line.toStdString();
}

Result<PlantGeometry> convert(const aiScene& scene, const QString& format, Progress& progress) {
  const bool gltf = format != QLatin1String("fbx");
  Result<assimp::File> file = assimp::indexScene(scene, gltf);
  if (!file) return file.error();
  PlantGeometry geometry;
  geometry.format = format;
  geometry.nodes = static_cast<int>(file->nodes.size());
  std::vector<assimp::Transform> binds;
  Result<BoneHints> hints = assimp::readBones(*file, geometry, binds);
  if (!hints) return hints.error();
  if (const Status status = assimp::readMeshes(*file, geometry); !status) return status.error();
  if (const Status status = checkSkeleton(geometry); !status) return status.error();
  assimp::readClips(*file, binds, geometry);
  assimp::readMaterials(scene, geometry);
  progress.report(0.7);
  if (progress.cancelled()) return Error{"cancelled", true};
  detectFoliage(geometry);
  fitTails(geometry, *hints);
  fitRadii(geometry);
  mendBones(geometry);
  progress.report(0.9);
  extractLeaves(geometry);
  progress.report(1);
  return geometry;
}

}  // namespace

Result<PlantGeometry> AssimpImporter::read(const SourceFile& file, const SurfaceSettings& surface,
                                           Progress& progress) const {
  const QString extension = QFileInfo(file.name).suffix().toLower();
  if (file.bytes.isEmpty()) return Error{"is empty"};
  if (extension != QLatin1String("fbx")) {
    if (const Status status = checkGltf(file.bytes, extension == QLatin1String("glb")); !status) return status.error();
  }
  try {
    Assimp::Importer importer;
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
    Result<PlantGeometry> geometry = convert(*scene, extension, progress);
    if (!geometry) return geometry;
    return withSurface(std::move(*geometry), surface, progress);
  } catch (const std::bad_alloc&) {
    return Error{"needs more memory than there is"};
  } catch (const std::exception& problem) {
    return Error{oneLine(problem.what())};
  }
}

}  // namespace windfall::model
