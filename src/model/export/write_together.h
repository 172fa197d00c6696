// Several files that belong together, all or none.
#pragma once

#include <QByteArray>
#include <QString>
#include <QStringList>
#include <vector>

#include "sim/result.h"

namespace windfall::model {

struct NamedBytes {
  QString name;  ///< in the folder
  QByteArray bytes;
};

/// Writes all under temporary names in `folder` (made where it is missing), then renames each: a full disk or a missing
/// permission leaves what was there. `stale` names, files of an earlier run, go last. Errors begin with the file's
/// name.
Status writeTogether(const QString& folder, const std::vector<NamedBytes>& files, const QStringList& stale = {});

/// One new file. The error says what the disk had against it, also where it took only a part.
Status writeBytes(const QString& path, const QByteArray& bytes);

}  // namespace windfall::model
