// An atlas as the files that a tool reads.
#pragma once

#include <QStringList>

#include "model/export/write_together.h"
#include "model/leaf/atlas.h"

namespace windfall::model {

/// STEM.png (colour with opacity), STEM_normal.png and the packed maps of the packer, and STEM.json, which names them
/// (docs/atlas.md). With `mipFiles` the colour's mip levels as STEM_mip1.png and on.
Result<std::vector<NamedBytes>> atlasFiles(const Atlas& atlas, const AtlasSettings& settings, const QString& stem,
                                           bool mipFiles = false);

/// Names that some packer would write for this stem but are not among `files`.
QStringList staleAtlasFiles(const QString& stem, const std::vector<NamedBytes>& files);

/// One picture of three or four maps of one size; null maps count as `255` or 0 by `missing`.
QImage packedChannels(const std::array<const QImage*, 4>& channels, const std::array<int, 4>& missing);

}  // namespace windfall::model
