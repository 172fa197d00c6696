#include "model/plant/assimp_importer.h"

#include "model/plant/assimp_private.h"
#include "model/plant/foliage.h"
#include "model/plant/import_repair.h"
#include "model/plant/skeleton_geometry.h"

namespace windfall::model {

namespace {

Result<PlantGeometry> convert(const aiScene& scene, const QString& format, Progress& progress) {
  const bool gltf = format != QLatin1String("fbx");
  Result<assimp::File> file = assimp::indexScene(scene, gltf);
  if (!file) return file.error();
  if (!file->armature) return Error{"has no armature: its mesh is not bound to bones"};
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

Result<PlantGeometry> AssimpImporter::read(const SourceFile& file, const SurfaceSettings& surface, WoodMesh wood,
                                           Progress& progress) const {
  PlantGeometry geometry;
  const Status status = assimp::withScene(file, progress, [&](const aiScene& scene) -> Status {
    Result<PlantGeometry> converted = convert(scene, assimp::extensionOf(file), progress);
    if (!converted) return converted.error();
    geometry = std::move(*converted);
    return ok();
  });
  if (!status) return status.error();
  return withSurface(std::move(geometry), surface, progress, wood);
}

}  // namespace windfall::model
