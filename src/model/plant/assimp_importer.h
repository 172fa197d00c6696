// FBX and glTF with an armature, through Assimp.
#pragma once

#include "model/plant/import.h"

namespace windfall::model {

class AssimpImporter : public PlantImporter {
 public:
  QString name() const override { return QStringLiteral("FBX and glTF"); }
  QStringList extensions() const override { return {"fbx", "glb", "gltf"}; }
  Result<PlantGeometry> read(const SourceFile& file, const SurfaceSettings& surface, WoodMesh wood,
                             Progress& progress) const override;
};

}  // namespace windfall::model
