// Names of assets: unique among their kind.
#pragma once

#include <QString>
#include <QStringList>

namespace windfall::model {

/// `wanted` if it is free, else its stem with the next free number: "Oak", "Oak 2", "Oak 3". An empty name becomes
/// `fallback`.
QString uniqueName(const QString& wanted, const QStringList& taken, const QString& fallback);

}  // namespace windfall::model
