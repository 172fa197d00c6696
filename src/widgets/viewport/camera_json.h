// A camera as a workspace's saved view.
#pragma once

#include <QJsonObject>
#include <optional>

#include "model/document/project.h"

namespace windfall::widgets {

QJsonObject toJson(const model::Camera& camera);
/// Nothing where a number is missing or is none that a camera can have.
std::optional<model::Camera> cameraFromJson(const QJsonObject& object);

}  // namespace windfall::widgets
