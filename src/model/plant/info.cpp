#include <algorithm>
#include <limits>

#include "model/plant/bodies.h"
#include "model/plant/skeleton_geometry.h"
#include "sim/self_buckling.h"

namespace windfall::model {

PlantInfo describe(const PlantGeometry& geometry, const PlantBodies& bodies) {
  PlantInfo info;
  info.format = geometry.format;
  info.nodes = geometry.nodes;
  std::vector<int> depth(geometry.bones.size(), 0);
  for (std::size_t b = 0; b < geometry.bones.size(); ++b) {
    const Bone& bone = geometry.bones[b];
    const int above = bone.parent < 0 ? 0 : depth[static_cast<std::size_t>(bone.parent)];
    depth[b] = above + (bone.weighted ? 1 : 0);
    info.depth = std::max(info.depth, depth[b]);
    info.bones += bone.weighted;
  }
  info.rigidBodies = static_cast<int>(bodies.tree.links.size());
  info.chains = static_cast<int>(bodies.branches.size());
  info.stems = info.rigidBodies;
  info.leaves = static_cast<int>(geometry.leafSites.size());
  info.maxInfluences = geometry.maxInfluences;
  for (const sim::Link& link : bodies.tree.links) info.totalStemLength += static_cast<double>(link.length);
  // Files of organs are counted as they are, with what is too short to be simulated.
  if (geometry.skeleton && (geometry.format == QLatin1String("prim") || geometry.format == QLatin1String("json"))) {
    const SkeletonCounts& counts = geometry.skeleton->counts;
    info.plants = counts.plants;
    info.stems = counts.stems;
    info.leaves = counts.leaves;
    info.buds = counts.buds;
    info.depth = counts.depth;
    info.totalStemLength = counts.stemLength;
  }
  info.mass = sim::totalMass(bodies.tree);
  info.firstFrequency = sim::firstFrequency(bodies.tree);
  info.selfBuckling = sim::selfBuckling(bodies.tree);
  for (const Clip& clip : geometry.clips) info.clips << clip.name;
  info.notes = geometry.notes + bodies.notes;
  if (!geometry.vertices.empty()) {
    info.lower = vec3(std::numeric_limits<float>::max());
    info.upper = -info.lower;
    for (const Vertex& vertex : geometry.vertices) {
      info.lower = glm::min(info.lower, vertex.position);
      info.upper = glm::max(info.upper, vertex.position);
    }
  }
  return info;
}

}  // namespace windfall::model
