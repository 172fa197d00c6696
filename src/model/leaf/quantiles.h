// Distributions of numbers, compared.
#pragma once

#include <vector>

namespace windfall::model {

/// `count` values at even shares of a sorted sequence, so that two of unlike length can be compared.
std::vector<float> quantiles(std::vector<float> values, int count);

/// Mean absolute difference of two lists of quantiles: the Wasserstein-1 distance.
double wasserstein(const std::vector<float>& a, const std::vector<float>& b);

}  // namespace windfall::model
