// Project files of older versions, brought up to date in memory.
#pragma once

#include <QJsonObject>

#include "sim/result.h"

namespace windfall::model {

/// Applies the upgrade functions from the document's schema to schemaVersion, one after the other. Refuses newer ones.
Result<QJsonObject> upgradeSchema(QJsonObject document);

}  // namespace windfall::model
