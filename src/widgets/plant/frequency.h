// The strongest frequency of a short record.
#pragma once

#include <span>

namespace windfall::widgets {

/// In Hz, of samples `interval` seconds apart: the peak of the Hann-windowed spectrum, refined by a parabola through it
/// and its neighbours. 0 where there are fewer than 32 samples or nothing moves.
double dominantFrequency(std::span<const float> samples, double interval);

}  // namespace windfall::widgets
