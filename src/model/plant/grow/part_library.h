// The artist's own parts: branches kept to be set on other plants.
#pragma once

#include <QString>
#include <vector>

#include "model/plant/geometry.h"
#include "model/plant/grow/hand_edit.h"
#include "sim/result.h"

namespace windfall::model {

/// A branch with all that it carries; its base is the origin, its first link points up.
struct PlantPart {
  QString name;
  std::vector<PartNode> nodes;
  QString file;  ///< where it is kept
  bool operator==(const PlantPart&) const = default;
};

/// The part that begins with a bone: it and all that it carries.
PlantPart partOf(const std::vector<Bone>& bones, std::size_t first, const QString& name);

QByteArray partToJson(const PlantPart& part);
/// Errors: not a part, links that lead nowhere, numbers that are none, more than 100,000 nodes.
Result<PlantPart> partFromJson(const QByteArray& json);

/// One .json file each in a folder of the application's data.
class PartLibrary {
 public:
  explicit PartLibrary(const QString& folder = {});
  const std::vector<PlantPart>& parts() const { return parts_; }
  /// Over the one of the same name.
  Status save(PlantPart part);
  Status remove(const QString& name);

 private:
  QString folder_;
  std::vector<PlantPart> parts_;
};

}  // namespace windfall::model
