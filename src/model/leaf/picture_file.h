// Whether a picture's file is all there.
#pragma once

#include <QByteArray>

#include "sim/result.h"

namespace windfall::model {

/// An error where a PNG or a JPEG ends too early, or a PNG's parts are not what they were written as: decoders would
/// give half a picture, or print lines of their own. Other formats pass.
Status checkPictureFile(const QByteArray& bytes);

}  // namespace windfall::model
