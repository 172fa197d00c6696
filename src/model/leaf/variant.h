// One new texture of a leaf asset, as its marks and parameters ask for it.
#pragma once

#include <span>

#include "model/leaf/stages.h"

namespace windfall::model {

/// A texture by `seed`: in the shape of `of`, or of another leaf of its kind where its shape varies, with the colours
/// of one of the `examples` in turn (none: its own); lendersOf joins those that serve one texture together. All have
/// reached Stage::Superpixels.
Result<Variant> makeVariant(const LeafStages& of, std::span<const LeafStages> examples, quint64 seed,
                            Progress& progress);

}  // namespace windfall::model
