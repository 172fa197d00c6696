// How a project's camera and light become a view of the renderer.
#pragma once

#include <optional>

#include "model/document/project.h"
#include "model/scene/assemble.h"
#include "widgets/render/view.h"
#include "widgets/viewport/orbit_camera.h"

namespace windfall::widgets {

/// Unit vector to the sun; azimuth clockwise from north (-Z).
vec3 sunDirection(const model::Light& light);

/// Camera, light and wind; size, time and highlights are left as they are by default.
render::View sceneView(const model::Camera& camera, const model::Scene& scene);

/// Box around all trees at rest, world space; nothing without trees.
std::optional<Box> sceneBox(const model::SceneAssembly& assembly, const model::Scene& scene);

}  // namespace windfall::widgets
