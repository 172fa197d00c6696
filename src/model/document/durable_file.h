// Writing a file so that no crash leaves half of it.
#pragma once

#include <QByteArray>
#include <QString>

#include "sim/result.h"

namespace windfall::model {

/// Replaces `path` by `bytes`: the old content is whole until the new one is, through a crash of the program or of the
/// machine at any moment. Folders are not made. Errors say why, without the file's name.
Status writeDurably(const QString& path, const QByteArray& bytes);

}  // namespace windfall::model
