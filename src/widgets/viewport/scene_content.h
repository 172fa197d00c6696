// From an assembled scene to what the renderer uploads.
#pragma once

#include "model/scene/assemble.h"
#include "widgets/render/content.h"

namespace windfall::widgets {

/// Meshes (one a plant and scale), trees in the order of the simulation, leaf textures. `leafCount` is the engine's.
/// Slow for large textures: meant for a job.
render::SceneContent makeContent(const model::SceneAssembly& assembly, const model::Scene& scene,
                                 std::size_t leafCount);

/// Rows from the top, straight alpha; empty for a null image.
render::Picture toPicture(const QImage& image);

}  // namespace windfall::widgets
