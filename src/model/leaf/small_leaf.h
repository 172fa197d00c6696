// Leaves made small, where only what is broad about them counts.
#pragma once

#include <vector>

#include "model/leaf/stages.h"

namespace windfall::model {

/// Long side of a small leaf, px: as the coarsest level of the guided synthesis.
inline constexpr int kSmallSide = 128;

/// Pixels of a leaf's structures that one of its small picture stands for, at least 1.
double smallFactor(QSize size);

/// The structures of a leaf of Stage::Superpixels, `factor` pixels one: mean distances, the label in the middle, veins
/// wherever one passes. Superpixels are left out, so are pictures; places (frame, scale, joined) fit the small size.
LeafStages smallStages(const LeafStages& stages, double factor);

/// Means of colours, three floats a pixel of `size`; pixels off the leaf (regions of `full`) do not count, and where
/// none does the colour is 0.
std::vector<float> smallColours(const std::vector<float>& lab, const LabelField& full, QSize small);

/// Colours of a small leaf's blade without detail and veins: its low-pass of 8 px at 512, `longSide` that of one leaf.
/// Three floats a pixel; 0 far off the blade.
std::vector<float> withoutDetail(const std::vector<float>& lab, const LabelField& regions, double longSide);

}  // namespace windfall::model
