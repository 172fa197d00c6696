#include <array>
#include <vector>

#include "model/leaf/thinning_private.h"

namespace windfall::model {

cv::Mat1b thinned(const cv::Mat1b& shape) {
  cv::Mat1b image = cv::Mat1b::zeros(shape.size());
  std::vector<cv::Point> live;
  for (int y = 1; y + 1 < shape.rows; ++y) {
    for (int x = 1; x + 1 < shape.cols; ++x) {
      if (!shape(y, x)) continue;
      image(y, x) = 255;
      live.emplace_back(x, y);
    }
  }
  static constexpr std::array<std::array<int, 2>, 8> kRing{
      {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}}};
  for (bool changed = true; changed;) {
    changed = false;
    for (const bool first : {true, false}) {
      std::vector<cv::Point> gone, stay;
      for (const cv::Point& p : live) {
        std::array<bool, 8> ring{};
        int filled = 0, rises = 0;
        for (size_t i = 0; i < 8; ++i) {
          ring[i] = image(p.y + kRing[i][1], p.x + kRing[i][0]) != 0;
          filled += ring[i];
        }
        for (size_t i = 0; i < 8; ++i) rises += !ring[i] && ring[(i + 1) % 8];
        const bool north = ring[0], east = ring[2], south = ring[4], west = ring[6];
        const bool open = first ? !(north && east && south) && !(east && south && west)
                                : !(north && east && west) && !(north && south && west);
        (filled >= 2 && filled <= 6 && rises == 1 && open ? gone : stay).push_back(p);
      }
      for (const cv::Point& p : gone) image(p) = 0;
      changed |= !gone.empty();
      live = std::move(stay);
    }
  }
  return image;
}

}  // namespace windfall::model
