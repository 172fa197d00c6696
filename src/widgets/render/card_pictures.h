// Pictures of clusters, painted from the leaves themselves into texture arrays, a part in each frame.
#pragma once

#include <vector>

#include "sim/result.h"
#include "widgets/render/card_set.h"
#include "widgets/render/gl_object.h"
#include "widgets/render/leaf_meshes.h"

namespace windfall::render {

/// A plant's pictures: a layer for each node and view.
struct CardPictures {
  Texture colours, surfaces;  ///< premultiplied; surfaces: normal in rest space, depth along the view
  Texture colourBytes;        ///< the same memory as `colours`, without sRGB, for writing
  float season = -1;

  bool empty() const { return !colours; }
};

/// Paints one plant after the other. The leaves' layers and maps must be bound (LeafPass::bindLooks).
class CardPainter {
 public:
  Status compile();
  /// For the shapes of the leaves' layers; forgets what was begun.
  void setMeshes(const LeafMeshBuffers& meshes, std::size_t layers);
  /// Begins anew where another plant or season was begun. Paints about `leaves` leaves of what is missing; true when
  /// all of it is there, and in `done`.
  Result<bool> paint(std::size_t number, const CardPlant& plant, const std::vector<CardNode>& nodes, float season,
                     std::size_t leaves, CardPictures& done);
  /// Memory that is only needed while pictures are painted.
  void release();

 private:
  Status begin(std::size_t number, const CardPlant& plant, float season);
  std::size_t paintPart(const CardPlant& plant, const std::vector<CardNode>& nodes, std::size_t leaves);
  void store(std::size_t firstLayer, std::size_t tiles);

  Program program_, store_;
  VertexArray array_;
  std::vector<DrawCommand> shapes_;  ///< of each layer
  Texture colours_, surfaces_, depth_;
  Framebuffer framebuffer_;
  Buffer leaves_, entries_, tiles_, places_, commands_;
  CardPictures pictures_;
  std::size_t number_ = 0, next_ = 0;
  int tile_ = 0;
  bool begun_ = false;
};

}  // namespace windfall::render
