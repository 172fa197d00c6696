#include "model/leaf/rect_packing.h"

#define STBRP_STATIC
#define STB_RECT_PACK_IMPLEMENTATION
#include <stb/stb_rect_pack.h>

namespace windfall::model {

std::optional<std::vector<QPoint>> packRectangles(const std::vector<QSize>& sizes, QSize whole) {
  std::vector<stbrp_rect> rectangles(sizes.size());
  for (size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i].width() > whole.width() || sizes[i].height() > whole.height()) return std::nullopt;
    rectangles[i].id = static_cast<int>(i);
    rectangles[i].w = sizes[i].width();
    rectangles[i].h = sizes[i].height();
  }
  std::vector<stbrp_node> nodes(static_cast<size_t>(whole.width()));
  stbrp_context context;
  stbrp_init_target(&context, whole.width(), whole.height(), nodes.data(), whole.width());
  if (!stbrp_pack_rects(&context, rectangles.data(), static_cast<int>(rectangles.size()))) return std::nullopt;
  std::vector<QPoint> corners(sizes.size());
  for (const stbrp_rect& r : rectangles) corners[static_cast<size_t>(r.id)] = QPoint(r.x, r.y);
  return corners;
}

}  // namespace windfall::model
