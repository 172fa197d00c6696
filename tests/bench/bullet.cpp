#include "peers.h"

#if defined(WINDFALL_HAS_BULLET)

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <memory>

#include "sim/bodies.h"
#include "sim/sample_tree.h"

using namespace windfall::sim;

namespace {

btVector3 vector(const glm::dvec3& v) {
  return {static_cast<btScalar>(v.x), static_cast<btScalar>(v.y), static_cast<btScalar>(v.z)};
}

btQuaternion turn(const glm::dquat& q) {
  return {static_cast<btScalar>(q.x), static_cast<btScalar>(q.y), static_cast<btScalar>(q.z),
          static_cast<btScalar>(q.w)};
}

constexpr btScalar kBeta = btScalar(0.02);  // s, damping over stiffness

struct BulletTree {
  std::vector<LinkBody> bodies;
  std::vector<btVector3> preStress;
  btMultiBody body{static_cast<int>(bodies.size()), 1, btVector3(1, 1, 1), true, false};
  btAlignedObjectArray<btScalar> numbers;
  btAlignedObjectArray<btVector3> vectors;
  btAlignedObjectArray<btMatrix3x3> matrices;

  explicit BulletTree(const SampleTreeSettings& settings) : bodies(bodiesOf(sampleTree(settings))) {
    const std::vector<Composite> composites = compositesOf(bodies);
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
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const glm::dvec3 torque = glm::cross(composites[i].moment, glm::dvec3(0, -9.81, 0));
      preStress.push_back(vector(glm::transpose(bodies[i].axes) * torque));
    }
    body.finalizeMultiDof();
    body.setBasePos(btVector3(0, 0, 0));
  }

  void step() {
    body.clearForcesAndTorques();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const int link = static_cast<int>(i);
      body.addLinkForce(link, btVector3(0, static_cast<btScalar>(-9.81 * bodies[i].mass), 0));
      // A spring about the rest pose that carries the weight there, and its damping.
      const btScalar *q = body.getJointPosMultiDof(link), *w = body.getJointVelMultiDof(link);
      btScalar torque[3];
      for (int k = 0; k < 3; ++k) {
        const auto stiffness = static_cast<btScalar>(bodies[i].stiffness[k]);
        torque[k] = -preStress[i][k] - stiffness * (2 * (q[3] < 0 ? -q[k] : q[k]) + kBeta * w[k]);
      }
      body.addJointTorqueMultiDof(link, torque);
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

std::vector<Contender> bulletContenders(const SampleTreeSettings& settings) {
  auto tree = std::make_shared<BulletTree>(settings);
  Contender contender;
  contender.name = "Bullet btMultiBody, spherical joints with springs, 1 thread";
  contender.items = static_cast<double>(tree->bodies.size());
  contender.repeats = tree->bodies.size() > 5000 ? 10 : 60;
  // From rest each time: its explicit springs do not bear a sixtieth of a second for long.
  contender.run = [tree] {
    tree->rest();
    tree->step();
  };
  return {contender};
}

#else

std::vector<windfall::sim::Contender> bulletContenders(const windfall::sim::SampleTreeSettings&) { return {}; }

#endif
