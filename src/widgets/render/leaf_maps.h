// The texture arrays of all leaf layers.
#pragma once

#include "sim/result.h"
#include "widgets/render/content.h"
#include "widgets/render/gl_object.h"
#include "widgets/render/leaf_cover.h"

namespace windfall::render {

class LeafMapArrays {
 public:
  /// Colours with their coverage kept in the mip levels, surfaces and ageing at half their size.
  Status upload(const std::vector<LeafLayer>& layers);
  void reset();
  /// Of each layer.
  const std::vector<LeafCover>& covers() const { return covers_; }
  /// Binds colours, surfaces and ageing to units 3, 4 and 5.
  void bind() const;
  bool empty() const { return !colours_; }

 private:
  Texture colours_, surfaces_, ageing_;
  std::vector<LeafCover> covers_;
};

}  // namespace windfall::render
