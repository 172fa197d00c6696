// How like a photograph of the example a made leaf is, without anybody looking (leaf_textures.md, 11).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "model/leaf/stages.h"

namespace windfall::model {

/// A leaf's colours and where they lie. Lengths of the score are meant for a long side of 512 px and grow with it.
struct ScoredLeaf {
  const LeafStructure* structure = nullptr;  ///< mask (regions), structural distance, veins (vein distance 0)
  std::vector<float> lab;                    ///< CIE L*a*b*, three floats a pixel of the structure's size
};

/// The four terms, 0..1, and what they are made of.
struct QualityTerms {
  double colour = 0;        ///< A: colours by structural distance, exp(-difference / 10)
  double texture = 0;       ///< B: energy of the bands and sharpness, exp(-(bands + gradients))
  double patches = 0;       ///< C: nothing there that the example lacks, nothing lacking that it has
  double veins = 0;         ///< D: colour across the veins, 1 - relative difference of the profiles, at least 0.02
  double difference = 0;    ///< Wasserstein-1 distance of the colours, mean over the leaf
  double bands = 0;         ///< |ln| of the ratio of the standard deviations, mean of 5 octaves
  double gradients = 0;     ///< Wasserstein-1 distance of ln(|grad L| + 0.05)
  double coherence = 1;     ///< 95th percentile of made-to-example distances over that within the example
  double completeness = 1;  ///< mean of example-to-made distances over that within the example
  double score() const;     ///< Q, 0..100: 100 times the fourth root of A B C D
};

/// What the score knows of an example, found once for many made leaves.
class QualityReference {
 public:
  /// `example` must live as long. Samples are drawn by a fixed seed: the same score for the same pictures.
  explicit QualityReference(const ScoredLeaf& example);
  ~QualityReference();
  QualityReference(QualityReference&&) noexcept;

  /// The made leaf needs not have the example's shape or size.
  QualityTerms score(const ScoredLeaf& made) const;

 private:
  struct Known;
  std::unique_ptr<const Known> known_;
};

/// Correlation of the low-pass Lab of two pictures of one leaf shape, -1..1; with the example's photo stretched into
/// the shape (stretchRows) 0.9 and more is a copy.
double copyIndex(const ScoredLeaf& made, const std::vector<float>& stretched);

/// Mean difference (CIE76) of the low-pass Lab of two pictures of one leaf shape: how unlike two seeds are.
double diversity(const ScoredLeaf& made, const std::vector<float>& other);

/// What the diversity of two random rearrangements of a leaf's own low-pass colours would be: a plain leaf's variants
/// cannot differ more without colours that it does not have.
double diversityCeiling(const ScoredLeaf& example);

/// The example's colours, stretched into the target's shape row by row, rows across the line from root to tip.
/// Axes in pixels of the structures.
std::vector<float> stretchRows(const LeafStructure& target, const std::array<QPointF, 2>& targetAxis,
                               const ScoredLeaf& example, const std::array<QPointF, 2>& exampleAxis);

}  // namespace windfall::model
