// What a viewport shows: whoever hands it content and frames.
#pragma once

#include "widgets/render/renderer.h"

namespace windfall::widgets {

/// Called by the viewport on the GUI thread with the renderer's context current.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// Before each draw: uploads what is new, publishes what is finished, asks for the next frame.
  virtual void prepare(render::Renderer& renderer) = 0;
  /// Light, wind, time and highlights of the next draw; the camera is the viewport's.
  virtual void describe(render::View& view) const = 0;
  /// The renderer goes away: after this call nobody writes into its memory.
  virtual void release() = 0;
};

}  // namespace windfall::widgets
