// OpenCV's SLIC, which drags a hundred libraries behind it: linked into this program alone.
#pragma once

#include "model/leaf/texture_bench.h"

/// OpenCV's SLIC on the structural distance; without `run` where ximgproc was not found when this was built.
windfall::model::SlicPeer openCvSlic();
