// What sets the variants of one leaf apart where its example's colours do not.
#pragma once

#include <vector>

#include "model/leaf/leaf_tones.h"
#include "model/progress.h"

namespace windfall::model {

/// Low-pass colours of a few variants made small, of one shape, and the tones of the example that they come from.
struct SmallVariants {
  LeafTones tones;
  LabelField regions;
  std::vector<std::vector<float>> low;  ///< withoutDetail; three floats a pixel
};

/// Small variants of a target with an example's colours, by seeds of their own: how unlike variants are before any tone
/// is added. Both have reached Stage::Superpixels; the same for any number of threads. None where it was cancelled.
SmallVariants smallVariants(const LeafStages& target, const LeafStages& example, const std::vector<float>& colours,
                            const SynthesisParameters& parameters, Progress& progress);

/// How far tones must set leaves off, CIE76, so that variants of seeds in a row differ by `wanted` on the mean; 0 where
/// they do so by themselves.
float toneStrength(const SmallVariants& variants, const TonePhase& phase, double wanted);

/// Sets a made leaf off by the tone of its seed. `lab`: three floats a pixel of `regions`; `phase` in its pixels. Veins
/// and detail keep their contrast.
void addTone(std::vector<float>& lab, const LabelField& regions, const LeafTones& tones, const TonePhase& phase,
             float strength, quint64 seed);

}  // namespace windfall::model
