#include "kernels/leaf_chain.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "kernels/random.h"

using namespace windfall;

TEST_CASE("the chain's integers are the published table") {
  constexpr double kPrinted[6][6] = {{.1538, .3462, .0385, .0385, .3077, .1154},
                                     {0, .3261, .0217, .0870, .3043, .2609},
                                     {0, 0, .4444, .0833, .2500, .2222},
                                     {0, 0, 0, .6957, .0870, .2174},
                                     {0, 0, 0, 0, .9231, .0769},
                                     {0, 0, 0, 0, 0, 1}};
  constexpr std::uint32_t kDenominators[6] = {26, 46, 36, 23, 13, 1};
  for (std::uint32_t row = 0; row < kLeafMotions; ++row) {
    const ChainRow counts = chainRow(row);
    std::uint32_t total = 0;
    for (const std::uint32_t count : counts.count) total += count;
    CHECK(total == kDenominators[row]);
    for (std::uint32_t column = 0; column < kLeafMotions; ++column) {
      CHECK(std::abs(counts.count[column] / static_cast<double>(total) - kPrinted[row][column]) <= 5.001e-5);
    }
  }
}

TEST_CASE("a million draws from each row follow its counts and never leave it") {
  // 99.9 % quantiles of chi squared for 1 to 5 degrees of freedom.
  constexpr double kLimit[6] = {0, 10.83, 13.82, 16.27, 18.47, 20.52};
  for (std::uint32_t row = 0; row < kLeafMotions; ++row) {
    const ChainRow counts = chainRow(row);
    std::uint32_t total = 0;
    for (const std::uint32_t count : counts.count) total += count;
    std::array<std::uint32_t, kLeafMotions> seen{};
    constexpr std::uint32_t kDraws = 1000000;
    for (std::uint32_t k = 0; k < kDraws; ++k) ++seen[nextMotion(row, hash(row, k))];
    double chi = 0;
    int kinds = 0;
    for (std::uint32_t column = 0; column < kLeafMotions; ++column) {
      if (counts.count[column] == 0) {
        CHECK(seen[column] == 0);
        continue;
      }
      ++kinds;
      const double expected = static_cast<double>(kDraws) * counts.count[column] / total;
      chi += (seen[column] - expected) * (seen[column] - expected) / expected;
    }
    CHECK(chi <= kLimit[kinds - 1]);
  }
  CHECK(nextMotion(kSteady, 0) == kSteady);
  CHECK(nextMotion(kSteady, 0xffffffffu) == kSpiralling);
  CHECK(firstMotion(0xffffffffu) == kHelical);
}
