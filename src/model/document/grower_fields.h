// What is kept of the growers and of edits by hand; see project_fields.h.
#pragma once

#include "model/document/fields.h"
#include "model/plant/plant.h"

namespace windfall::model {

template <class Io>
void fields(Io& io, typename Io::template Ref<CrownSettings> crown) {
  io.number("base", crown.base, 0, 200);
  io.number("radius", crown.radius, 0.001, 100);
  io.number("widest", crown.widest, 0, 1);
  io.number("lowPower", crown.lowPower, 0.2, 20);
  io.number("highPower", crown.highPower, 0.2, 20);
  io.points("profile", crown.profile);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<ColonizationSettings> colony) {
  io.object("crown", colony.crown);
  io.number("points", colony.points, 1, 400'000);
  io.number("shell", colony.shell, 0.05, 3);
  io.number("step", colony.step, 0.005, 10);
  io.number("influence", colony.influence, 0.01, 1000);
  io.number("kill", colony.kill, 0, 1000);
  io.number("upward", colony.upward, -10, 10);
  io.number("trunkTop", colony.trunkTop, 0, 200);
  io.number("trunkWander", colony.trunkWander, 0, 10);
  io.number("noise", colony.noise, 0, 10);
  io.number("lobes", colony.lobes, 0, 1000);
  io.number("lobeSize", colony.lobeSize, 0, 10);
  io.number("stems", colony.stems, 1, 64);
  io.number("hangingLength", colony.hangingLength, 0, 50);
  io.number("hangingStep", colony.hangingStep, 0.02, 10);
  io.number("hangingShare", colony.hangingShare, 0, 1);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<SelfOrganizingSettings> growth) {
  io.number("rate", growth.rate, 1e-4, 10);
  io.number("power", growth.power, 0.1, 10);
  io.number("internode", growth.internode, 0.005, 5);
  io.number("vigour", growth.vigour, 0, 100);
  io.number("leader", growth.leader, 0, 1);
  io.number("model", growth.model, 0, 2);
  io.number("density", growth.density, 0, 10);
  io.number("falloff", growth.falloff, 1, 10);
  io.number("shadowDepth", growth.shadowDepth, 0, 20);
  io.number("arrangement", growth.arrangement, 0, 2);
  io.number("buds", growth.buds, 1, 12);
  io.number("angle", growth.angle, 0, 180);
  io.number("light", growth.light, 0, 10);
  io.number("upward", growth.upward, -10, 10);
  io.number("level", growth.level, 0, 10);
  io.flag("sprays", growth.sprays);
  io.number("apical", growth.apical, 0, 10);
  io.number("longestShoot", growth.longestShoot, 1, 50);
  io.number("pruning", growth.pruning, 0, 100);
  io.number("leastWeight", growth.leastWeight, 0, 1);
  io.number("favoured", growth.favoured, 0, 1);
  io.number("bole", growth.bole, 0, 1);
  io.number("reach", growth.reach, 0, 10);
  io.number("basalBuds", growth.basalBuds, 0, 30);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<LSystemSettings> rules) {
  io.text("rules", rules.rules, 65'536);
  io.number("iterations", rules.iterations, 0, 1000);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<FoliageSettings> foliage) {
  io.flag("leaves", foliage.leaves);
  io.number("look", foliage.look, 0, 9);
  io.number("length", foliage.length, 1e-3, 10);
  io.number("cluster", foliage.cluster, 1, 64);
  io.number("leafyLength", foliage.leafyLength, 0, 100);
  io.number("arrangement", foliage.arrangement, 0, 2);
  io.number("petiole", foliage.petiole, 0, 10);
  io.number("droop", foliage.droop, -5, 5);
  io.number("shoot", foliage.shoot, 0.001, 10);
  io.number("amount", foliage.amount, 0, 100);
  io.number("areaFactor", foliage.areaFactor, 0.001, 10);
  io.number("mostLayers", foliage.mostLayers, 0, 1000);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<WoodSettings> wood) {
  io.number("tipRadius", wood.tipRadius, 1e-4, 0.5);
  io.number("bark", wood.bark, 0, 10);
  io.number("breakage", wood.breakage, 0, 1);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<PartNode> node) {
  io.vector("position", node.position);
  io.number("parent", node.parent, -1, 1'000'000);
  io.number("radius", node.radius, 0, 100);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<QVector3D> point) {
  io.vector("at", point);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<HandEdit> edit) {
  io.number("kind", edit.kind, 0, 5);
  io.number("node", edit.node, -1, 2'147'483'647);
  io.vector("place", edit.place);
  io.number("age", edit.age, 0, 1e4);
  io.number("stub", edit.stub, 0, 1);
  io.vector("axis", edit.axis);
  io.number("angle", edit.angle, -kFarthest, kFarthest);
  io.number("factor", edit.factor, 0.001, 1000);
  io.number("radius", edit.radius, 0, 100);
  io.vector("offset", edit.offset);
  io.list("line", edit.line, 10'000);
  io.list("part", edit.part, 100'000);
}

}  // namespace windfall::model
