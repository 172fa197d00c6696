#include "model/plant/hierarchy.h"

#include <QThread>
#include <algorithm>
#include <memory>

namespace windfall::model {

Result<int> levelsOf(const std::vector<std::ptrdiff_t>& parent, const std::function<std::string(std::size_t)>& nameOf) {
  std::vector<int> depth(parent.size(), 0);
  std::vector<std::size_t> path;
  int levels = 0;
  for (std::size_t i = 0; i < parent.size(); ++i) {
    path.clear();
    auto at = static_cast<std::ptrdiff_t>(i);
    while (at >= 0 && depth[static_cast<std::size_t>(at)] == 0) {
      path.push_back(static_cast<std::size_t>(at));
      if (path.size() > parent.size()) return Error{nameOf(i) + " is its own ancestor"};
      at = parent[static_cast<std::size_t>(at)];
    }
    int above = at >= 0 ? depth[static_cast<std::size_t>(at)] : 0;
    while (!path.empty()) {
      depth[path.back()] = ++above;
      path.pop_back();
    }
    if (above > kMostLevels) return Error{nameOf(i) + " lies more than 150,000 levels deep"};
    levels = std::max(levels, above);
  }
  return levels;
}

bool runWithDeepStack(int levels, const std::function<void()>& work) {
  // Measured with Assimp 5.2: a chain of 100,000 nodes needs between 2 and 2.6 kB of stack each; pages that are not
  // touched cost nothing.
  constexpr uint kBase = 16u << 20, kLevel = 5u << 10;
  bool done = false;
  const std::unique_ptr<QThread> thread(QThread::create([&] {
    work();
    done = true;
  }));
  thread->setStackSize(kBase + kLevel * static_cast<uint>(std::clamp(levels, 0, kMostLevels)));
  thread->start();
  thread->wait();
  return done;
}

}  // namespace windfall::model
