// The barks of all adaptive trees in one texture array, so that one draw call has them all.
#pragma once

#include <cstdint>
#include <vector>

#include "widgets/render/content.h"
#include "widgets/render/gl_object.h"

namespace windfall::render {

/// On the GPU: colour, width of the tile, look, twigs and mean of the picture of each layer (storage 3), and their
/// pictures (texture 3).
struct Barks {
  Buffer looks;
  Texture pictures;
  bool allPictured = false;
  void bind() const;
};

/// Collects the materials of adaptive parts; meshes of equal looks and pictures share a layer. 256 at most: what comes
/// later gets the first.
class BarkLayers {
 public:
  explicit BarkLayers(const SceneContent& content) : content_(content) {}
  std::uint32_t layerOf(int mesh);
  Barks upload() const;

 private:
  const Material& materialOf(int mesh) const;
  const Picture* pictureOf(int mesh) const;

  const SceneContent& content_;
  std::vector<int> meshes_;  ///< a layer: the mesh that it was first seen on
};

}  // namespace windfall::render
