// Skeletons of any number of bones, made by the tests themselves.
#pragma once

#include <QByteArray>
#include <vector>

#include "kernels/math.h"

namespace windfall::test {

/// Bones that fork evenly: bone i hangs at the end of bone (i - 1) / fanOut. With a fan of 1 it is one chain; a fan of
/// `bones` hangs all on the first. Each has a four-sided tube of its own, bound to it alone.
struct BoneForest {
  int bones = 0, fanOut = 1;

  std::vector<int> parent;
  std::vector<vec3> head, tail;  ///< m
  std::vector<float> radius;     ///< m

  BoneForest(int count, int fan);
};

/// As .glb, with skins of 50,000 joints at most: glTF numbers the joints of a vertex in 16 bits.
QByteArray gltfOf(const BoneForest& forest);
/// As binary FBX 7.4, in metres.
QByteArray fbxOf(const BoneForest& forest);

}  // namespace windfall::test
