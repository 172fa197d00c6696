#include "peers.h"

#if defined(WINDFALL_HAS_BULLET)

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <memory>

#include "sim/bodies.h"
#include "sim/sample_tree.h"

using namespace windfall::sim;

namespace {

constexpr int kSteps = 10;

btVector3 vector(const glm::dvec3& v) {
  return {static_cast<btScalar>(v.x), static_cast<btScalar>(v.y), static_cast<btScalar>(v.z)};
}

btQuaternion turn(const glm::dquat& q) {
  return {static_cast<btScalar>(q.x), static_cast<btScalar>(q.y), static_cast<btScalar>(q.z),
          static_cast<btScalar>(q.w)};
}

struct BulletTree {
  std::vector<LinkBody> bodies = bodiesOf(sampleTree(tenThousandLinks()));
  btMultiBody body{static_cast<int>(bodies.size()), 1, btVector3(1, 1, 1), true, false};
  btAlignedObjectArray<btScalar> numbers;
  btAlignedObjectArray<btVector3> vectors;
  btAlignedObjectArray<btMatrix3x3> matrices;

  BulletTree() {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const LinkBody& link = bodies[i];
      const bool root = link.parent < 0;
      const LinkBody& parent = bodies[root ? i : static_cast<std::size_t>(link.parent)];
      const glm::dquat relative = root ? link.rotation : glm::conjugate(parent.rotation) * link.rotation;
      const glm::dvec3 center = root ? glm::dvec3(0) : parent.joint + parent.arm();
      const glm::dvec3 pivot = root ? link.joint : glm::transpose(parent.axes) * (link.joint - center);
      body.setupSpherical(static_cast<int>(i), static_cast<btScalar>(link.mass),
                          vector(glm::dvec3(link.across, link.across, link.along)), link.parent,
                          turn(relative).inverse(), vector(pivot), vector(glm::dvec3(0, 0, 0.5 * link.length)), true);
    }
    body.finalizeMultiDof();
    body.setBasePos(btVector3(0, 0, 0));
  }

  void step() {
    body.clearForcesAndTorques();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      body.addLinkForce(static_cast<int>(i), btVector3(0, static_cast<btScalar>(-9.81 * bodies[i].mass), 0));
    }
    const btScalar h = btScalar(1) / 60;
    body.computeAccelerationsArticulatedBodyAlgorithmMultiDof(h, numbers, vectors, matrices, false, false, false);
    body.stepPositionsMultiDof(h);
  }

  void rest() {
    const btScalar straight[] = {0, 0, 0, 1}, still[] = {0, 0, 0};
    for (int i = 0; i < body.getNumLinks(); ++i) {
      body.setJointPosMultiDof(i, straight);
      body.setJointVelMultiDof(i, still);
    }
  }
};

}  // namespace

std::vector<Contender> bulletContenders() {
  auto tree = std::make_shared<BulletTree>();
  Contender contender;
  contender.name = "Bullet btMultiBody, without springs and wind, 1 thread";
  contender.items = static_cast<double>(tree->bodies.size()) * kSteps;
  // Ten steps from rest each time: what falls freely for longer flies apart.
  contender.run = [tree] {
    tree->rest();
    for (int i = 0; i < kSteps; ++i) tree->step();
  };
  return {contender};
}

#else

std::vector<windfall::sim::Contender> bulletContenders() { return {}; }

#endif
