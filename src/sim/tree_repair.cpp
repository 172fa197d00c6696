#include "sim/tree_repair.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "sim/link_limits.h"

namespace windfall::sim {

namespace {

constexpr float kStubShare = 0.05f;  // of the tree's median length
constexpr float kThinner = 0.7f;     // a child's radius over its parent's
constexpr float kSlender = 0.05f;    // a root's radius over its length

/// Counts faults of one kind.
class Fault {
 public:
  Fault(const char* one, const char* many) : one_(one), many_(many) {}
  void at(std::int32_t index) {
    if (count_++ == 0) first_ = index;
  }
  void tell(std::vector<std::string>& notes) const {
    if (count_ == 0) return;
    const std::string first = std::to_string(first_);
    notes.push_back(count_ == 1 ? "link " + first + " " + one_
                                : std::to_string(count_) + " links " + many_ + "; the first is link " + first);
  }

 private:
  const char *one_, *many_;
  std::int32_t first_ = 0;
  std::int64_t count_ = 0;
};

/// The turn that brings z to a direction.
quat alongOf(const vec3& to) {
  if (to.z < -0.9999f) return {0, 1, 0, 0};
  return glm::normalize(quat(1 + to.z, -to.y, to.x, 0));
}

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

/// Cuts parents that are not there and loops.
void mendParents(std::vector<Link>& links, std::vector<std::string>& notes) {
  Fault missing("has a parent that is not there and becomes a root",
                "have a parent that is not there and become roots");
  Fault loops("is its own ancestor and becomes a root", "are their own ancestors and become roots");
  const auto count = static_cast<std::int32_t>(links.size());
  for (std::int32_t i = 0; i < count; ++i) {
    std::int32_t& parent = links[at(i)].parent;
    if (parent >= -1 && parent < count) continue;
    parent = -1;
    missing.at(i);
  }
  // Upward from every link, until a root or a way that was gone before.
  std::vector<std::int32_t> way(links.size(), -1);
  for (std::int32_t i = 0; i < count; ++i) {
    std::int32_t k = i;
    while (k >= 0 && way[at(k)] < 0) {
      way[at(k)] = i;
      k = links[at(k)].parent;
    }
    if (k < 0 || way[at(k)] != i) continue;
    // Back at a link of the same way: a loop, whose lowest link shall be its root.
    std::int32_t lowest = k;
    for (std::int32_t m = links[at(k)].parent; m != k; m = links[at(m)].parent) lowest = std::min(lowest, m);
    links[at(lowest)].parent = -1;
    loops.at(lowest);
  }
  missing.tell(notes);
  loops.tell(notes);
}

/// Depth first, children in the order in which they stand.
std::vector<std::int32_t> preorder(const std::vector<Link>& links) {
  const std::size_t n = links.size();
  std::vector<std::int32_t> firstChild(n, -1), sibling(n, -1), open, order;
  std::int32_t firstRoot = -1;
  for (std::size_t i = n; i-- > 0;) {
    std::int32_t& first = links[i].parent < 0 ? firstRoot : firstChild[at(links[i].parent)];
    sibling[i] = first;
    first = static_cast<std::int32_t>(i);
  }
  order.reserve(n);
  if (firstRoot >= 0) open.push_back(firstRoot);
  while (!open.empty()) {
    const std::int32_t i = open.back();
    open.pop_back();
    order.push_back(i);
    if (sibling[at(i)] >= 0) open.push_back(sibling[at(i)]);
    if (firstChild[at(i)] >= 0) open.push_back(firstChild[at(i)]);
  }
  return order;
}

void reorder(Tree& tree, TreeRepair& repair) {
  repair.from = preorder(tree.links);
  repair.reordered = !std::is_sorted(repair.from.begin(), repair.from.end());
  if (!repair.reordered) return;
  repair.notes.emplace_back("its links are put in another order, parents before their children");
  std::vector<std::int32_t> to(tree.links.size());
  std::vector<Link> links;
  links.reserve(tree.links.size());
  for (const std::int32_t i : repair.from) {
    to[at(i)] = static_cast<std::int32_t>(links.size());
    links.push_back(tree.links[at(i)]);
  }
  for (Link& link : links) {
    if (link.parent >= 0) link.parent = to[at(link.parent)];
  }
  for (LeafSite& site : tree.sites) {
    if (site.link >= 0 && at(site.link) < to.size()) site.link = to[at(site.link)];
  }
  tree.links = std::move(links);
}

/// Places, turns and lengths; parents are mended before their children.
void mendShape(std::vector<Link>& links, std::vector<std::string>& notes) {
  Fault nowhere("is nowhere and begins where its parent ends", "are nowhere and begin where their parents end");
  Fault turns("has no direction and takes that of its child or parent",
              "have no direction and take that of their children or parents");
  Fault lengths("has no length and becomes a stub", "have no length and become stubs");
  Fault thin("has no thickness and takes a part of its parent's",
             "have no thickness and take a part of their parents'");
  Fault huge("is beyond all measure and is made smaller", "are beyond all measure and are made smaller");
  std::vector<float> sound;
  for (const Link& link : links) {
    if (isLength(link.length)) sound.push_back(link.length);
  }
  float median = 0.1f;
  if (!sound.empty()) {
    const auto middle = sound.begin() + static_cast<std::ptrdiff_t>(sound.size() / 2);
    std::nth_element(sound.begin(), middle, sound.end());
    median = *middle;
  }
  std::vector<std::int32_t> child(links.size(), -1);
  for (std::size_t i = links.size(); i-- > 1;) {
    if (links[i].parent >= 0 && isPlace(links[i].joint)) child[at(links[i].parent)] = static_cast<std::int32_t>(i);
  }
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto index = static_cast<std::int32_t>(i);
    Link& link = links[i];
    const Link* parent = link.parent < 0 ? nullptr : &links[at(link.parent)];
    if (!isPlace(link.joint)) {
      link.joint = parent ? parent->joint + parent->rotation * vec3(0, 0, parent->length) : vec3(0);
      if (!isPlace(link.joint)) link.joint = parent->joint;
      nowhere.at(index);
    }
    const vec3 way = child[i] < 0 ? vec3(0) : links[at(child[i])].joint - link.joint;
    const float reach = glm::length(way);
    if (!isUnit(link.rotation)) {
      const quat up = glm::angleAxis(-1.5707963f, vec3(1, 0, 0));
      const quat& q = link.rotation;
      const float norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
      if (norm > 1e-12f && norm < 1e12f) {
        link.rotation = glm::normalize(q);
      } else if (isLength(reach)) {
        link.rotation = alongOf(way / reach);
      } else {
        link.rotation = parent ? parent->rotation : up;
      }
      if (!isUnit(link.rotation)) link.rotation = up;
      turns.at(index);
    }
    // One giant among others of usual size is a fault of its own; a whole tree of them is of another unit.
    if (sound.empty() && link.length > kLongest) {
      link.length = kLongest;
      huge.at(index);
    }
    if (!isLength(link.length)) {
      link.length = isLength(reach) && reach < 10 * median ? reach : std::max(kStubShare * median, 1e-4f);
      lengths.at(index);
    }
    if (link.radius > kThickest) {
      link.radius = kThickest;
      huge.at(index);
    }
    if (!isRadius(link.radius)) {
      link.radius = parent ? kThinner * parent->radius : kSlender * link.length;
      if (!isRadius(link.radius)) link.radius = 1e-4f;
      thin.at(index);
    }
  }
  for (const Fault* fault : {&nowhere, &turns, &lengths, &thin, &huge}) fault->tell(notes);
}

/// Material and the artist's factors.
void mendNumbers(std::vector<Link>& links, std::vector<std::string>& notes) {
  Fault wood("has wood of no density or stiffness and gets the usual one",
             "have wood of no density or stiffness and get the usual one");
  Fault leaves("has a leaf area that is no number and gets none", "have a leaf area that is no number and get none");
  Fault factors("has a factor of stiffness, damping or wind that is no number and gets the usual one",
                "have factors of stiffness, damping or wind that are no numbers and get the usual ones");
  const Link usual;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto index = static_cast<std::int32_t>(i);
    Link& link = links[i];
    const auto mend = [&](float& value, bool good, float instead, Fault& fault) {
      if (good) return;
      value = instead;
      fault.at(index);
    };
    mend(link.woodDensity, isDensity(link.woodDensity), usual.woodDensity, wood);
    mend(link.youngsModulus, isModulus(link.youngsModulus), usual.youngsModulus, wood);
    mend(link.leafArea, isFactor(link.leafArea), 0, leaves);
    mend(link.stiffnessScale, isFactor(link.stiffnessScale), 1, factors);
    mend(link.dampingScale, isFactor(link.dampingScale), 1, factors);
    mend(link.windScale, isFactor(link.windScale), 1, factors);
    mend(link.rayleighAlpha, isFactor(link.rayleighAlpha), 0, factors);
    mend(link.rayleighBeta, isFactor(link.rayleighBeta), 0, factors);
    mend(link.propagation, isFactor(link.propagation), usual.propagation, factors);
  }
  for (const Fault* fault : {&wood, &leaves, &factors}) fault->tell(notes);
}

void dropSites(Tree& tree, std::vector<std::string>& notes) {
  const auto count = static_cast<std::int32_t>(tree.links.size());
  const std::size_t lost = std::erase_if(tree.sites, [&](const LeafSite& site) { return !isSite(site, count); });
  if (lost == 1) notes.emplace_back("one leaf hangs on no link and is dropped");
  if (lost > 1) notes.push_back(std::to_string(lost) + " leaves hang on no link and are dropped");
}

}  // namespace

TreeRepair repairTree(Tree& tree) {
  TreeRepair repair;
  mendParents(tree.links, repair.notes);
  reorder(tree, repair);
  mendShape(tree.links, repair.notes);
  mendNumbers(tree.links, repair.notes);
  dropSites(tree, repair.notes);
  return repair;
}

}  // namespace windfall::sim
