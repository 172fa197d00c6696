#include "model/leaf/joined_examples.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "model/leaf/image_cv_private.h"
#include "model/leaf/leaf_tones.h"
#include "model/leaf/region_match.h"
#include "model/leaf/working_colours.h"

namespace windfall::model {

namespace {

constexpr int kGap = 16;  // px: no patch and no superpixel reaches over it
/// CIE76 between the mean colours of two blades: up to here another light, from there on another season.
constexpr float kCast = 10, kSeason = 30;

/// How much of a difference between two leaves is taken for a cast.
float castShare(float difference) {
  const float t = std::clamp((difference - kCast) / (kSeason - kCast), 0.f, 1.f);
  return 1 - t * t * (3 - 2 * t);
}

/// Rows of about as many leaves as there are rows.
std::vector<QRect> gridOf(const std::vector<LeafStages>& examples, QSize& whole) {
  const auto columns = static_cast<size_t>(std::ceil(std::sqrt(static_cast<double>(examples.size()))));
  std::vector<QRect> places;
  int x = 0, y = 0, height = 0;
  whole = {0, 0};
  for (size_t i = 0; i < examples.size(); ++i) {
    if (i > 0 && i % columns == 0) x = 0, y += height + kGap, height = 0;
    const QSize size = examples[i].seen.distance.size;
    places.emplace_back(QPoint(x, y), size);
    whole = whole.expandedTo({x + size.width(), y + size.height()});
    x += size.width() + kGap;
    height = std::max(height, size.height());
  }
  return places;
}

size_t indexIn(QSize size, int x, int y) {
  return static_cast<size_t>(y) * static_cast<size_t>(size.width()) + static_cast<size_t>(x);
}

/// Calls `copy(to, from)` for every pixel of a part that lies at `place` in the whole.
template <class Copy>
void overPart(QSize whole, const QRect& place, Copy copy) {
  for (int y = 0; y < place.height(); ++y) {
    for (int x = 0; x < place.width(); ++x) {
      copy(indexIn(whole, place.x() + x, place.y() + y), indexIn(place.size(), x, y));
    }
  }
}

/// The structure of one of the joined leaves again.
LeafStructure partOf(const LeafStructure& structure, const QRect& place) {
  LeafStructure part;
  part.distance = {place.size(), {}, structure.distance.unit};
  part.veinDistance = {place.size(), {}, structure.veinDistance.unit};
  part.regions.size = place.size();
  const size_t pixels = static_cast<size_t>(place.width()) * static_cast<size_t>(place.height());
  part.distance.values.resize(pixels);
  part.veinDistance.values.resize(pixels);
  part.regions.values.resize(pixels);
  part.regions.count = structure.regions.count;
  overPart(structure.distance.size, place, [&](size_t to, size_t from) {
    part.distance.values[from] = structure.distance.values[to];
    part.veinDistance.values[from] = structure.veinDistance.values[to];
    part.regions.values[from] = structure.regions.values[to];
  });
  return part;
}

}  // namespace

LeafStages joinExamples(const std::vector<LeafStages>& examples, double evenTones) {
  LeafStages whole;
  QSize size;
  const std::vector<QRect> places = gridOf(examples, size);
  const size_t pixels = static_cast<size_t>(size.width()) * static_cast<size_t>(size.height());
  LeafStructure& seen = whole.seen;
  for (ScalarField* field : {&seen.distance, &seen.veinDistance}) *field = {size, std::vector<float>(pixels, 0.f)};
  for (LabelField* field : {&seen.regions, &seen.superpixels}) {
    field->size = size;
    field->values.assign(pixels, 0);
  }
  QImage photo(size, QImage::Format_RGBA8888);
  photo.fill(Qt::transparent);
  whole.alpha = QImage(size, QImage::Format_Grayscale8);
  whole.alpha.fill(0);
  bool stalks = false;
  for (const LeafStages& example : examples) {
    stalks = stalks || example.seen.regions.petiole > 0;
    const int blades = example.seen.regions.count - (example.seen.regions.petiole > 0 ? 1 : 0);
    seen.regions.count += blades;
  }
  if (stalks) seen.regions.petiole = ++seen.regions.count;
  seen.regions.wholes.assign(static_cast<size_t>(seen.regions.count), 0.0);
  double coarsest = 1e9, allPixels = 0;
  std::array<float, 3> first{};
  int before = 0;
  for (size_t i = 0; i < examples.size(); ++i) {
    const LeafStages& example = examples[i];
    const LabelField& regions = example.seen.regions;
    const QPointF corner = places[i].topLeft();
    const bool stalk = regions.petiole > 0;
    const int blades = regions.count - (stalk ? 1 : 0), superpixels = seen.superpixels.count;
    whole.joined.push_back({example.made.id, places[i], example.frame, example.scale,
                            example.toWorking(example.root) + corner, example.toWorking(example.tip) + corner, before,
                            regions.count, stalk});
    double own = 0;
    overPart(size, places[i], [&](size_t to, size_t from) {
      seen.distance.values[to] = example.seen.distance.values[from];
      seen.veinDistance.values[to] = example.seen.veinDistance.values[from];
      const qint32 region = regions.values[from], superpixel = example.seen.superpixels.values[from];
      seen.regions.values[to] = region <= 0                          ? 0
                                : stalk && region == regions.petiole ? seen.regions.count
                                                                     : before + region;
      seen.superpixels.values[to] = superpixel > 0 ? superpixels + superpixel : 0;
      own += region > 0;
    });
    for (int n = before; n < before + blades; ++n) seen.regions.wholes[static_cast<size_t>(n)] = own;
    allPixels += own;
    before += blades;
    seen.superpixels.count += example.seen.superpixels.count;
    std::vector<float> colours = workingColours(example);
    if (evenTones > 0) {
      const std::array<float, 3> mean = measureTones(example, colours).mean;
      if (i == 0) first = mean;
      std::array<float, 3> by{};
      for (size_t c = 0; c < 3; ++c) by[c] = first[c] - mean[c];
      const float share = static_cast<float>(evenTones) * castShare(std::hypot(by[0], by[1], by[2]));
      for (float& channel : by) channel *= share;
      shiftColours(colours, by);
    }
    const cv::Mat3f lab(places[i].height(), places[i].width(), reinterpret_cast<cv::Vec3f*>(colours.data()));
    const QImage picture = fromLab(lab, cv::Mat1b(lab.rows, lab.cols, static_cast<uchar>(255)));
    QPainter(&photo).drawImage(places[i].topLeft(), picture);
    QPainter(&whole.alpha).drawImage(places[i].topLeft(), example.alpha);
    coarsest = std::min(coarsest, example.scale);
  }
  if (stalks) seen.regions.wholes.back() = allPixels;
  // Units are px of textures, about alike.
  if (!examples.empty()) {
    seen.distance.unit = examples.front().seen.distance.unit;
    seen.veinDistance.unit = examples.front().seen.veinDistance.unit;
  }
  // As coarse as the coarsest photo: what was enlarged has nothing to find between its pixels.
  whole.scale = std::max(1.0, coarsest);
  const QSize small(std::max(1, static_cast<int>(std::lround(size.width() / whole.scale))),
                    std::max(1, static_cast<int>(std::lround(size.height() / whole.scale))));
  whole.photo = small == size ? photo : photo.scaled(small, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
  whole.photo = whole.photo.convertToFormat(QImage::Format_RGBA8888);
  whole.frame = whole.photo.rect();
  // Its colours were spread over the ground already; nothing more is to be left out.
  whole.mask = QImage(small, QImage::Format_Grayscale8);
  whole.mask.fill(255);
  whole.grown.distance.size = size;
  whole.reached = Stage::Superpixels;
  return whole;
}

std::vector<LeafStages> lendersOf(const LeafStages& of, std::vector<LeafStages> examples) {
  if (examples.size() < 2 || !of.made.parameters.regions.mix) return examples;
  std::vector<LeafStages> joined;
  joined.push_back(joinExamples(examples, of.made.parameters.regions.evenTones));
  return joined;
}

VeinFrame exampleFrame(const LeafStages& example) {
  if (example.joined.empty()) {
    return findVeinFrame(example.seen, example.toWorking(example.root), example.toWorking(example.tip));
  }
  const QSize size = example.seen.distance.size;
  const size_t pixels = example.seen.distance.values.size();
  VeinFrame frame{std::vector<float>(pixels), std::vector<signed char>(pixels, 1), std::vector<float>(pixels),
                  std::vector<float>(pixels), std::vector<float>(pixels),          1};
  for (const JoinedLeaf& leaf : example.joined) {
    const QPointF corner = leaf.place.topLeft();
    const VeinFrame own = findVeinFrame(partOf(example.seen, leaf.place), leaf.root - corner, leaf.tip - corner);
    frame.longSide = std::max(frame.longSide, own.longSide);
    overPart(size, leaf.place, [&](size_t to, size_t from) {
      frame.angle[to] = own.angle[from];
      frame.side[to] = own.side[from];
      frame.reach[to] = own.reach[from];
      frame.margin[to] = own.margin[from];
      frame.standing[to] = own.standing[from];
    });
  }
  return frame;
}

int exampleRegionAt(const LeafStages& example, AssetId leaf, AssetId target, QPointF photo) {
  const auto is = [&](AssetId id) { return leaf == id || (leaf == AssetId{} && id == target); };
  if (example.joined.empty()) return is(example.made.id) ? regionAt(example, example.seen.regions, photo) : 0;
  for (const JoinedLeaf& part : example.joined) {
    if (!is(part.id)) continue;
    const QPointF at = part.toWhole(photo);
    const QPoint place(static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())));
    if (!part.place.contains(place)) return 0;
    return example.seen.regions.values[indexIn(example.seen.regions.size, place.x(), place.y())];
  }
  return 0;
}

}  // namespace windfall::model
