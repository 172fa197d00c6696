// Smoothing of a masked picture by a linear system (leaf_textures.md, 8).
#pragma once

#include <QSize>
#include <vector>

namespace windfall::model {

/// Minimises sum |x_i - b_i|^2 + w1 sum over edges |x_i - x_j|^2 inside the mask, by red-black successive
/// over-relaxation. `values`: three floats a pixel, in and out; pixels with mask 0 are left alone. The same bits for
/// any number of threads.
void smooth(std::vector<float>& values, const std::vector<unsigned char>& mask, QSize size, double w1, int sweeps);

/// Enough sweeps for a residual of 1e-5 at this w1.
int sweepsFor(double w1);

}  // namespace windfall::model
