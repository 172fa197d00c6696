// How deep a file's nodes are nested, before anything walks them by recursion.
#pragma once

#include <QByteArray>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "sim/result.h"

namespace windfall::model {

/// Deeper files are refused: reading takes a stack of some kilobytes a level.
inline constexpr int kMostLevels = 150'000;

/// Levels of a forest: 1 for roots alone. `parent` holds the index of each node's parent, or -1; `nameOf` says what an
/// error calls a node ("node 7"). Errors for a node that is its own ancestor and for more than kMostLevels.
Result<int> levelsOf(const std::vector<std::ptrdiff_t>& parent, const std::function<std::string(std::size_t)>& nameOf);

/// Runs `work` to its end on a thread whose stack holds a recursion over so many levels: a few kilobytes each in
/// Assimp. False when there is no memory for one.
bool runWithDeepStack(int levels, const std::function<void()>& work);

}  // namespace windfall::model
