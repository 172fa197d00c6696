// How leaves are packed into one picture.
#pragma once

#include <QString>
#include <optional>

namespace windfall::model {

/// For whom the maps are packed together.
enum class AtlasPacker {
  Plain,   ///< every map a file of its own
  Gltf,    ///< occlusion, roughness and metal in one; transmission's colour
  Unity,   ///< mask map: metal, occlusion, detail, smoothness
  Unreal,  ///< as glTF, with the normal map's green turned over; subsurface colour
};

struct AtlasSettings {
  int size = 0;      ///< side, a power of two; 0: the smallest, or half of it, that holds the leaves as large as wanted
  int padding = 16;  ///< px at least between leaves, filled with the leaves' own colours
  int mipLevels = 1;   ///< that must stay free of neighbours: the gap is at least 8 px, doubled for each
  bool rotate = true;  ///< leaves may lie on their side where that packs better
  AtlasPacker packer = AtlasPacker::Plain;
  int leafPixels = 0;  ///< wanted long side of the largest leaf, px; 0: as its texture was made
  bool operator==(const AtlasSettings&) const = default;

  /// Gap between leaves in px: padding or what the mip levels want, an eighth of the side at most (where it is known).
  int gap() const;
};

/// "plain", "gltf", "unity", "unreal".
QString nameOf(AtlasPacker packer);
std::optional<AtlasPacker> packerOf(const QString& name);

}  // namespace windfall::model
