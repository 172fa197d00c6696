// A damped oscillator under a constant load, solved exactly over a step of any length (tree_dynamics.md, 5.3).
#pragma once

#include "kernels/link_algebra.h"

namespace windfall {

/// y'' + 2 b y' + lambda y = lambda y_e over a step h: e = y - y_e goes to e stay + y' gain, y' to y' keep - e pull.
template <class R>
struct OscillatorStep {
  R stay, gain, keep, pull;
};

/// lambda > 0, b >= 0. The energy y'^2 / 2 + lambda e^2 / 2 never grows, whatever h.
template <class R>
WINDFALL_HD OscillatorStep<R> oscillatorStep(const R& lambda, const R& b, const R& h) {
  const R d = lambda - b * b;
  const auto under = d > R(0.0f);
  const R size = select(under, d, -d);
  const R root = squareRoot(largerOf(size, R(1e-30f)));
  // The slow rate of strong damping is lambda / (b + s): b - s would cancel.
  const R fast = b + root;
  const R first = expOf(select(under, -(b * h), -(lambda * h) / fast));
  const R second = expOf(-(fast * h));
  // Of more turns than single precision tells apart only the size matters.
  const R turns = smallerOf(root * h * R(0.15915494309189535), R(262144.0f));
  const SinCosOf<R> wave = sinCosTurns(turns);
  const R half(0.5f);
  R c = select(under, first * wave.cos, half * (first + second));
  R s = select(under, first * wave.sin, half * (first - second)) / root;
  // Near critical damping the two merge: series in d h^2, whose next term is below 1e-20.
  const R x = d * h * h;
  const auto critical = size * h * h < R(1e-6f);
  const R plain = expOf(-(b * h));
  c = select(critical, plain * (R(1.0f) - x * (half - x * R(1.0 / 24))), c);
  s = select(critical, h * plain * (R(1.0f) - x * (R(1.0 / 6) - x * R(1.0 / 120))), s);
  return {c + b * s, s, c - b * s, lambda * s};
}

}  // namespace windfall
