// How alike two pictures look.
#pragma once

#include "widgets/render/content.h"

namespace windfall::widgets {

/// Mean structural similarity of brightness over windows of 8 x 8 pixels, a window each 4 pixels (Wang, Bovik, Sheikh,
/// Simoncelli 2004); 1: equal. Pictures of the same size, premultiplied by
/// their alpha; behind them is a clear sky.
double similarity(const render::Picture& a, const render::Picture& b);

}  // namespace windfall::widgets
