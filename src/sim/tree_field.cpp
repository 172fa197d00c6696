#include "sim/tree_field.h"

#include <algorithm>
#include <cmath>

#include "kernels/link_loops.h"
#include "kernels/link_step.h"

namespace windfall::sim {

TreeField::TreeField(std::vector<TreeInstance> trees, const FactorSettings& settings, int threads,
                     std::uint32_t treeletSize)
    : trees_(std::move(trees)), threads_(std::max(threads, 1)) {
  std::vector<std::int32_t> parents;
  for (const TreeInstance& instance : trees_) {
    const auto first = static_cast<std::uint32_t>(parents.size());
    firstLinks_.push_back(first);
    for (const Link& link : instance.tree->links) {
      parents.push_back(link.parent < 0 ? -1 : link.parent + static_cast<std::int32_t>(first));
    }
  }
  partition_ = partition(parents, treeletSize);
  shapes_.resize(parents.size());
  factors_.resize(parents.size());
  motion_.resize(parents.size());
  loads_.resize(parents.size());
  inertia_.resize(parents.size());
  before_.resize(parents.size());
  after_.resize(parents.size());
  exports_.resize(partition_.treelets.size());
  lostArea_.resize(parents.size());
  for (const TreeInstance& instance : trees_) frequencies_.push_back(firstFrequency(*instance.tree));
  factorise(settings);
  reset();
}

void TreeField::factoriseTree(std::size_t instance) {
  ++revision_;
  const Tree& tree = *trees_[instance].tree;
  const std::size_t first = firstLinks_[instance], count = tree.links.size();
  const std::vector<LinkBody> bodies =
      bodiesOf(tree, trees_[instance].placement, std::span<const float>(lostArea_).subspan(first, count));
  windfall::sim::factorise(bodies, frequencies_[instance], settings_, static_cast<std::int32_t>(first),
                           std::span(shapes_).subspan(first, count), std::span(factors_).subspan(first, count),
                           std::span(inertia_).subspan(first, count));
}

void TreeField::factorise(const FactorSettings& settings) {
  settings_ = settings;
  for (std::size_t t = 0; t < trees_.size(); ++t) factoriseTree(t);
}

void TreeField::setLostArea(std::span<const float> area) {
  std::copy(area.begin(), area.end(), lostArea_.begin());
  factorise(settings_);
}

void TreeField::setTree(std::size_t instance, std::shared_ptr<const Tree> tree) {
  trees_[instance].tree = std::move(tree);
  frequencies_[instance] = firstFrequency(*trees_[instance].tree);
  factoriseTree(instance);
}

LinksView TreeField::view() {
  return {shapes_.data(), factors_.data(), motion_.data(), loads_.data(), before_.data(), after_.data()};
}

void TreeField::reset() {
  std::fill(motion_.begin(), motion_.end(), LinkMotion{});
  pose();
}

void TreeField::pose() {
  ++revision_;
  linkPoseRange(view(), 0, static_cast<std::uint32_t>(size()));
  before_ = after_;
}

void TreeField::setPoses(std::span<const LinkState> before, std::span<const LinkState> after) {
  ++revision_;
  std::copy(before.begin(), before.end(), before_.begin());
  std::copy(after.begin(), after.end(), after_.begin());
}

void TreeField::step(const WindView& wind) {
  if (motion_.empty()) return;
  before_.swap(after_);
  sweep(view(), wind);
}

void TreeField::takeStep(std::vector<LinkMotion>& motion, std::vector<LinkState>& now) {
  motion_.swap(motion);
  before_.swap(after_);
  after_.swap(now);
}

void TreeField::sweep(const LinksView& links, const WindView& wind) {
  const LinkStepParameters parameters{static_cast<float>(settings_.h), static_cast<float>(settings_.implicitness)};
  const Partition& cut = partition_;
  const auto orderOf = [&](const Treelet& part) {
    return std::span<const std::uint32_t>(cut.order).subspan(part.begin, part.end - part.begin);
  };
  const auto groups = static_cast<std::ptrdiff_t>(cut.groups.size()) - 1;
  const auto top = static_cast<std::ptrdiff_t>(cut.top.size());
#pragma omp parallel num_threads(threads_) if (groups > 3)
  {
#pragma omp for schedule(static) nowait
    for (std::ptrdiff_t i = 0; i < top; ++i) {
      const std::uint32_t link = cut.top[static_cast<std::size_t>(i)];
      linkForcesRange(links, wind, link, link + 1);
    }
#pragma omp for schedule(static)
    for (std::ptrdiff_t g = 0; g < groups; ++g) {
      const auto group = static_cast<std::size_t>(g);
      for (std::size_t t = cut.groups[group]; t < cut.groups[group + 1]; ++t) {
        const Treelet part = cut.treelets[t];
        linkForcesRange(links, wind, part.begin, part.end);
        exports_[t] = linkUpRange(links, parameters, orderOf(part));
      }
    }
#pragma omp single
    {
      // Every parent sums its children from the last to the first, as inside a treelet.
      for (const Crossing& crossing : cut.crossings) {
        const std::int32_t parent = links.shape[crossing.link].parent;
        const LinkLoad load = crossing.treelet >= 0 ? exports_[static_cast<std::size_t>(crossing.treelet)]
                                                    : linkUpRange(links, parameters, {&crossing.link, 1});
        if (parent >= 0) addLoad(links.load[parent], load);
      }
      linkDownRange(links, parameters, cut.top);
    }
#pragma omp for schedule(static)
    for (std::ptrdiff_t g = 0; g < groups; ++g) {
      const auto group = static_cast<std::size_t>(g);
      for (std::size_t t = cut.groups[group]; t < cut.groups[group + 1]; ++t) {
        linkDownRange(links, parameters, orderOf(cut.treelets[t]));
      }
    }
  }
}

double TreeField::kineticEnergy() const {
  double sum = 0;
  for (std::size_t i = 0; i < motion_.size(); ++i) {
    const LinkMotion& m = motion_[i];
    const LinkInertia& body = inertia_[i];
    const float r = shapes_[i].halfLength;
    const vec3 o = m.angularVelocity, v = m.velocity + vec3(o.y * r, -o.x * r, 0);
    sum += 0.5 * static_cast<double>(body.mass * glm::dot(v, v) + body.across * (o.x * o.x + o.y * o.y) +
                                     body.along * o.z * o.z + body.floor * m.speed.z * m.speed.z);
  }
  return sum;
}

double TreeField::elasticEnergy() const {
  double sum = 0;
  for (std::size_t i = 0; i < motion_.size(); ++i) {
    const vec3& angle = motion_[i].angle;
    sum += 0.5 * static_cast<double>(glm::dot(angle, shapes_[i].stiffness * angle));
  }
  return sum;
}

float TreeField::largestAngle() const {
  float largest = 0;
  for (const LinkMotion& m : motion_) largest = std::max(largest, glm::dot(m.angle, m.angle));
  return std::sqrt(largest);
}

}  // namespace windfall::sim
