// Where on a leaf ageing comes first; private to model.
#pragma once

#include <QImage>

#include "model/leaf/vein_fields_private.h"

namespace windfall::model {

/// R: when a place loses its green, 0 first .. 255 last (veins, and what is near the root); G: when it browns, from the
/// margin inwards; B: how much it reddens, by the light that it had (leaf_textures.md, 10). A: 255.
QImage ageingImage(const VeinFields& fields, quint64 seed);

}  // namespace windfall::model
