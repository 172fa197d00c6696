#include "model/leaf/field_picture.h"

#include <QPainter>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "kernels/random.h"
#include "model/leaf/vein_frame.h"

namespace windfall::model {

namespace {

constexpr int kRampSteps = 64;

/// Anchors of a colour map that gets evenly lighter: dark violet, blue, green, yellow.
QRgb mapColour(float value) {
  static constexpr std::array<std::array<float, 3>, 6> kAnchors{
      {{68, 1, 84}, {65, 68, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};
  const float place = std::clamp(value, 0.f, 1.f) * 5;
  const auto low = static_cast<size_t>(std::min(4.f, std::floor(place)));
  const float t = place - static_cast<float>(low);
  const auto channel = [&](size_t c) {
    return static_cast<int>(std::lround(kAnchors[low][c] * (1 - t) + kAnchors[low + 1][c] * t));
  };
  return qRgba(channel(0), channel(1), channel(2), 255);
}

/// A wheel of hues: directions that differ little look alike, also across half a turn.
QRgb wheelColour(float turn) { return QColor::fromHsvF(turn - std::floor(turn), 0.62f, 0.95f).rgba(); }

QImage overPhoto(const LeafStages& stages, const QImage& working) {
  QImage whole(stages.photo.size(), QImage::Format_ARGB32);
  whole.fill(Qt::transparent);
  QPainter(&whole).drawImage(stages.frame.topLeft(),
                             working.scaled(stages.frame.size(), Qt::IgnoreAspectRatio, Qt::SmoothTransformation));
  return whole;
}

template <class ColourOf>
QImage paint(const LeafStages& stages, ColourOf colourOf) {
  const QSize size = stages.grown.distance.size;
  QImage image(size, QImage::Format_ARGB32);
  image.fill(Qt::transparent);
  for (int y = 0; y < size.height(); ++y) {
    auto* row = reinterpret_cast<QRgb*>(image.scanLine(y));
    const uchar* leaf = stages.alpha.constScanLine(y);
    for (int x = 0; x < size.width(); ++x) {
      if (leaf[x] < 128) continue;
      row[x] = colourOf(static_cast<size_t>(y) * static_cast<size_t>(size.width()) + static_cast<size_t>(x));
    }
  }
  return overPhoto(stages, image);
}

}  // namespace

QImage fieldPicture(const LeafStages& stages, LeafField field, FieldScale& scale) {
  scale = {};
  for (int i = 0; i < kRampSteps; ++i) {
    const float t = static_cast<float>(i) / (kRampSteps - 1);
    scale.ramp.push_back(field == LeafField::Direction ? wheelColour(t) : mapColour(t));
  }
  if (field == LeafField::Structural || field == LeafField::VeinDistance) {
    const bool structural = field == LeafField::Structural;
    const ScalarField& values = structural ? stages.grown.distance : stages.grown.veinDistance;
    float highest = 1e-6f;
    for (const float value : values.values) highest = std::max(highest, value);
    scale.high = values.unit * static_cast<double>(highest);
    return paint(stages, [&](size_t i) { return mapColour(values.values[i] / highest); });
  }
  const VeinFrame frame = findVeinFrame(stages.grown, stages.toWorking(stages.root), stages.toWorking(stages.tip));
  switch (field) {
    case LeafField::Direction:
      scale.low = -180;
      scale.high = 180;
      return paint(stages, [&](size_t i) {
        // Shown with y upwards, as angles are drawn.
        return wheelColour(0.5f - frame.angle[i] / (2 * std::numbers::pi_v<float>));
      });
    case LeafField::Side:
      scale.ramp = {qRgb(86, 160, 211), qRgb(230, 159, 0)};
      scale.low = -1;
      scale.twoKinds = true;
      return paint(stages, [&](size_t i) { return scale.ramp[frame.side[i] < 0 ? 0 : 1]; });
    default:
      return paint(stages, [&](size_t i) { return mapColour(frame.margin[i]); });
  }
}

namespace {
/// A sixth of the colour over a light grey.
QRgb paler(QRgb colour) {
  const auto mixed = [](int channel) { return (channel + 5 * 205) / 6; };
  return qRgb(mixed(qRed(colour)), mixed(qGreen(colour)), mixed(qBlue(colour)));
}
}  // namespace

QRgb regionColour(int label) {
  const auto seed = static_cast<std::uint32_t>(label);
  const float hue = std::fmod(0.61803399f * static_cast<float>(label), 1.f);
  return QColor::fromHsvF(hue, 0.45f + 0.3f * uniform(7, seed, 1), 0.70f + 0.28f * uniform(7, seed, 2)).rgba();
}

QImage regionPicture(const LeafStages& stages, const LabelField& regions, const std::vector<int>& colourOf) {
  const int width = regions.size.width(), height = regions.size.height();
  QImage image(regions.size, QImage::Format_ARGB32);
  image.fill(Qt::transparent);
  for (int y = 0; y < height; ++y) {
    auto* row = reinterpret_cast<QRgb*>(image.scanLine(y));
    for (int x = 0; x < width; ++x) {
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      const qint32 label = regions.values[i];
      if (label <= 0 || label > static_cast<qint32>(colourOf.size())) continue;
      const bool edge = (x + 1 < width && regions.values[i + 1] != label) ||
                        (y + 1 < height && regions.values[i + static_cast<size_t>(width)] != label);
      const int number = colourOf[static_cast<size_t>(label - 1)];
      row[x] = edge ? qRgba(20, 20, 20, 255) : number < 0 ? paler(regionColour(-number)) : regionColour(number);
    }
  }
  return overPhoto(stages, image);
}

}  // namespace windfall::model
