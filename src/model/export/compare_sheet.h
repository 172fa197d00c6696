// The photograph beside what each method makes of it, on one sheet to be looked at.
#pragma once

#include <QImage>
#include <vector>

#include "model/leaf/stages.h"

namespace windfall::model {

/// One picture on a sheet with its name below it.
struct SheetPicture {
  QString label;
  QImage image;  ///< straight alpha
};

/// Rows of pictures at their full size on a neutral grey, each under the other at the left; labels below them.
/// Needs a QGuiApplication (fonts).
QImage compareSheet(const std::vector<std::vector<SheetPicture>>& rows);

/// The photographs, and three seeds from `seed` on of the classic and the guided method each, with the other parameters
/// of the target. Without `examples` the target lends its own colours; else they take turns.
Result<QImage> compareMethods(const LeafStages& target, const std::vector<LeafStages>& examples,
                              const SynthesisParameters& parameters, quint64 seed, Progress& progress);

}  // namespace windfall::model
