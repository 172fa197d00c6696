#include "model/leaf/ageing.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/image_cv_private.h"

namespace windfall::model {

namespace {

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / std::max(1e-9, high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// A threshold that runs over a field of 0..1 and a little beyond, so that 0 is before and 1 after all of it.
float running(double progress) { return static_cast<float>(-0.35 + 1.7 * progress); }

float logistic(float x) { return 1 / (1 + std::exp(-x)); }

cv::Vec3f mix(const cv::Vec3f& a, const cv::Vec3f& b, float t) { return a + (b - a) * t; }

}  // namespace

double LeafAge::dryness(double wetness) const {
  return std::clamp((0.15 * fading + 0.85 * browning) * (1.25 - 0.6 * wetness), 0.0, 1.0);
}

LeafAge leafAge(const AgeingParameters& parameters) {
  const double t = parameters.age, air = 0.10 * (parameters.wetness - 0.5);
  return {smooth(0.02, 0.52, t), smooth(0.18, 0.62, t), smooth(0.48 + air, 1.0, t)};
}

std::array<SeasonStates, 4> dailyChange(const AgeingParameters& parameters) {
  std::array<SeasonStates, 4> chain{{{0.93, 0.06, 0.01, 0}, {0, 0.90, 0.04, 0.06}, {0, 0, 0.93, 0.07}, {0, 0, 0, 1}}};
  const double pace = std::exp2((12 - parameters.temperature) / 6), dry = 1.5 - parameters.wetness;
  for (size_t from = 0; from < 4; ++from) {
    double leaving = 0;
    for (size_t to = from + 1; to < 4; ++to) {
      double& chance = chain[from][to];
      // The note's numbers are those of a species of redness 0.3 in air of wetness 0.5.
      chance *= pace * (to == 3 ? dry : 1.0) * (to == 2 ? parameters.redness / 0.3 : 1.0);
      leaving += chance;
    }
    const double scale = leaving > 0.98 ? 0.98 / leaving : 1;
    for (size_t to = from + 1; to < 4; ++to) chain[from][to] *= scale;
    chain[from][from] = 1 - leaving * scale;
  }
  return chain;
}

SeasonStates statesAfter(double days, const AgeingParameters& parameters) {
  const auto chain = dailyChange(parameters);
  SeasonStates states{1, 0, 0, 0};
  const auto next = [&](const SeasonStates& now) {
    SeasonStates after{};
    for (size_t from = 0; from < 4; ++from) {
      for (size_t to = 0; to < 4; ++to) after[to] += now[from] * chain[from][to];
    }
    return after;
  };
  days = std::clamp(days, 0.0, 1000.0);
  const int whole = static_cast<int>(days);
  for (int day = 0; day < whole; ++day) states = next(states);
  const SeasonStates after = next(states);
  const double part = days - whole;
  for (size_t i = 0; i < 4; ++i) states[i] += (after[i] - states[i]) * part;
  return states;
}

double seasonDays(double season) { return 45 * std::pow(std::clamp(season, 0.0, 1.0), 1.5); }

LeafAge ageOfRank(double rank, const SeasonStates& states) {
  // Who turns first stands first: ranks count from the last to turn, so that each limit only ever falls.
  const double green = states[0], yellow = green + states[1], red = yellow + states[2];
  // About the limit, from wholly before while the limit is 1 to wholly past where it is 0.
  const auto past = [rank](double limit, double width) { return smooth(0, 1, (rank - limit) / width + 1 - limit); };
  return {past(green, 0.2), states[2] + states[3] > 1e-9 ? past(yellow, 0.2) : 0, past(red, 0.3)};
}

std::array<std::array<float, 3>, 3> ageColours(const AgeingParameters& parameters) {
  const auto w = static_cast<float>(parameters.warmth), r = static_cast<float>(parameters.redness);
  return {{{78 - 16 * w, 2 + 24 * w, 66 - 10 * w},
           {44 - 4 * r, 38 + 14 * r, 34 - 6 * r},
           {40 - 3 * w, 11 + 5 * w, 22 + 4 * w}}};
}

namespace {

/// The target colours for a leaf of this mean: one that is not green any more keeps its own yellow and red.
std::array<cv::Vec3f, 3> targetsFor(const std::array<float, 3>& mean, const AgeingParameters& parameters) {
  const auto colours = ageColours(parameters);
  const cv::Vec3f own(mean[0], mean[1], mean[2]);
  const double hue = std::atan2(own[2], own[1]) * 180 / CV_PI, chroma = std::hypot(own[1], own[2]);
  const auto green = static_cast<float>(std::max(smooth(88, 104, hue), 1 - smooth(6, 14, chroma)));
  std::array<cv::Vec3f, 3> targets;
  for (size_t i = 0; i < 3; ++i) {
    const cv::Vec3f colour(colours[i][0], colours[i][1], colours[i][2]);
    targets[i] = i < 2 ? mix(own, colour, green) : colour;
  }
  return targets;
}

}  // namespace

std::array<float, 3> meanLab(const QImage& texture) {
  const cv::Mat3f lab = toLab(texture);
  const cv::Mat4b pixels = rgbaView(texture);
  double sum[3]{}, count = 0;
  for (int y = 0; y < lab.rows; ++y) {
    for (int x = 0; x < lab.cols; ++x) {
      if (pixels(y, x)[3] < 250) continue;
      for (int c = 0; c < 3; ++c) sum[c] += lab(y, x)[c];
      count += 1;
    }
  }
  if (count == 0) return {50, 0, 0};
  return {static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count), static_cast<float>(sum[2] / count)};
}

QImage agedTexture(const QImage& texture, const QImage& ageing, const LeafAge& age,
                   const AgeingParameters& parameters) {
  const QImage source = texture.convertToFormat(QImage::Format_RGBA8888);
  if (source.size() != ageing.size() || (age.fading <= 0 && age.browning <= 0)) return source;
  cv::Mat3f lab = toLab(source);
  const cv::Mat4b fields = rgbaView(ageing), pixels = rgbaView(source);
  const std::array<float, 3> mean = meanLab(source);
  const cv::Vec3f own(mean[0], mean[1], mean[2]);
  const auto [yellow, red, brown] = targetsFor(mean, parameters);
  const float fade = running(age.fading), die = running(age.browning);
  const float redder = static_cast<float>(age.reddening * std::min(1.0, 1.6 * parameters.redness));
  for (int y = 0; y < lab.rows; ++y) {
    for (int x = 0; x < lab.cols; ++x) {
      const cv::Vec4b& field = fields(y, x);
      const float green = logistic((static_cast<float>(field[0]) / 255 - fade) / 0.07f);
      const float dead = logistic((die - static_cast<float>(field[1]) / 255) / 0.05f);
      const float anthocyanin = std::min(1.f, redder * static_cast<float>(field[2]) / 140) * (1 - green);
      const cv::Vec3f deviation = lab(y, x) - own;
      // Dead tissue keeps its relief of light and dark but little of its hues.
      cv::Vec3f target = mix(own, yellow, 1 - green);
      target = mix(target, red, anthocyanin);
      target = mix(target, brown, dead);
      const float hue = 1 - 0.35f * (1 - green) - 0.4f * dead;
      lab(y, x) = target + cv::Vec3f(deviation[0] * (1 - 0.15f * dead), deviation[1] * hue, deviation[2] * hue);
    }
  }
  cv::Mat1b alpha;
  cv::extractChannel(pixels, alpha, 3);
  return fromLab(lab, alpha);
}

std::array<std::array<float, 3>, 3> ageGains(const QImage& texture, const AgeingParameters& parameters) {
  const auto linear = [](const cv::Vec3f& lab) {
    const cv::Mat3f pixel(1, 1, lab);
    cv::Mat3f rgb;
    cv::cvtColor(pixel, rgb, cv::COLOR_Lab2LRGB);
    return rgb(0, 0);
  };
  const std::array<float, 3> mean = meanLab(texture.convertToFormat(QImage::Format_RGBA8888));
  const cv::Vec3f own = linear({mean[0], mean[1], mean[2]});
  const auto colours = targetsFor(mean, parameters);
  std::array<std::array<float, 3>, 3> gains{};
  for (size_t i = 0; i < 3; ++i) {
    const cv::Vec3f target = linear(colours[i]);
    for (int c = 0; c < 3; ++c) {
      // Shadows of one channel must not blow up.
      gains[i][static_cast<size_t>(c)] =
          std::clamp(std::max(0.004f, target[c]) / std::max(0.008f, own[c]), 0.05f, 12.f);
    }
  }
  return gains;
}

}  // namespace windfall::model
