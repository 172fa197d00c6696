// What is kept of each part of a project, and between which limits; the same text writes and reads.
// Limits keep nonsense and hostile numbers out; they are wider than what the window offers.
#pragma once

#include "model/document/fields.h"
#include "model/document/grower_fields.h"
#include "model/document/project.h"

namespace windfall::model {

/// io: a FieldWriter or a FieldReader.
template <class Io>
void fields(Io& io, typename Io::template Ref<MaskParameters> mask) {
  io.flag("keepHoles", mask.keepHoles);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<VeinParameters> veins) {
  io.seed("seed", veins.seed);
  io.flag("fromPhoto", veins.fromPhoto);
  io.number("detail", veins.detail, 1e-6, 1);
  io.number("mains", veins.mains, 0, 100);
  io.number("laterals", veins.laterals, 0, 1000);
  io.number("basalAngle", veins.basalAngle, -360, 360);
  io.number("apicalAngle", veins.apicalAngle, -360, 360);
  io.number("wiggle", veins.wiggle, 0, 180);
  io.number("firstLateral", veins.firstLateral, 0, 1);
  io.number("lastLateral", veins.lastLateral, 0, 1);
  io.number("stagger", veins.stagger, -1, 1);
  io.flag("leftSide", veins.leftSide);
  io.flag("rightSide", veins.rightSide);
  io.flag("bezier", veins.bezier);
  io.flag("micro", veins.micro);
  io.flag("closed", veins.closed);
  io.number("microSpacing", veins.microSpacing, 1e-3, 1);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<ShapeParameters> shape) {
  io.flag("vary", shape.vary);
  io.number("aspect", shape.aspect, 0, 1);
  io.number("asymmetry", shape.asymmetry, 0, 1);
  io.number("lobes", shape.lobes, 0, 1);
  io.number("teeth", shape.teeth, 0, 1);
  io.number("toothCount", shape.toothCount, 1, 1000);
  io.number("holes", shape.holes, 0, 1000);
  io.number("bites", shape.bites, 0, 1000);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<RegionParameters> regions) {
  io.flag("scaleFree", regions.scaleFree);
  io.number("best", regions.best, 0, 1);
  io.flag("mix", regions.mix);
  io.number("evenTones", regions.evenTones, 0, 1);
  io.flag("hold", regions.hold);
  io.seed("seed", regions.seed);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<Ruler> ruler) {
  io.point("from", ruler.from);
  io.point("to", ruler.to);
  io.number("metres", ruler.metres, 1e-6, 1000);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<RegionPair> pair) {
  io.place("target", pair.target);
  io.seed("example", pair.example.value);
  io.place("source", pair.source);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<DistanceCosts> costs) {
  io.number("veinVein", costs.veinVein, 0, 1e6);
  io.number("veinTissue", costs.veinTissue, 0, 1e6);
  io.number("tissueTissue", costs.tissueTissue, 0, 1e6);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<SynthesisParameters> synthesis) {
  io.number("size", synthesis.size, 16, 8192);
  io.flag("guided", synthesis.guided);
  io.number("superpixels", synthesis.superpixels, 1, 1e6);
  io.number("candidates", synthesis.candidates, 1, 10'000);
  io.number("levels", synthesis.levels, 1, 5);
  io.number("choices", synthesis.choices, 1, 10'000);
  io.flag("detail", synthesis.detail);
  io.flag("asThesis", synthesis.asThesis);
  io.number("guideWeight", synthesis.guideWeight, 0, 1e6);
  io.number("smoothing", synthesis.smoothing, 0, 1e6);
  io.number("variety", synthesis.variety, 0, 100);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<MapParameters> maps) {
  io.number("relief", maps.relief, 0, 100);
  io.number("gloss", maps.gloss, 0, 1);
  io.number("detail", maps.detail, 0, 100);
  io.number("thickness", maps.thickness, 0, 100);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<AgeingParameters> ageing) {
  io.number("age", ageing.age, 0, 1);
  io.number("temperature", ageing.temperature, -100, 100);
  io.number("wetness", ageing.wetness, 0, 1);
  io.number("redness", ageing.redness, 0, 1);
  io.number("warmth", ageing.warmth, 0, 1);
}

/// `packer` is kept by name.
template <class Io>
void fields(Io& io, typename Io::template Ref<AtlasSettings> atlas) {
  io.number("size", atlas.size, 0, 16384);
  io.number("leafPixels", atlas.leafPixels, 0, 8192);
  io.number("padding", atlas.padding, 0, 2048);
  io.number("mipLevels", atlas.mipLevels, 0, 12);
  io.flag("rotate", atlas.rotate);
  QString packer = nameOf(atlas.packer);
  io.text("packer", packer);
  if constexpr (std::is_same_v<Io, FieldReader>) {
    if (const auto known = packerOf(packer)) {
      atlas.packer = *known;
    } else if (!io.failed()) {
      io.fail(io.inside("packer"), QStringLiteral("is none that Windfall knows"));
    }
  }
}

template <class Io>
void fields(Io& io, typename Io::template Ref<LeafParameters> parameters) {
  io.object("mask", parameters.mask);
  io.number("epsilon", parameters.epsilon, 0, 1e5);
  io.object("shape", parameters.shape);
  io.object("veins", parameters.veins);
  io.object("costs", parameters.costs);
  io.object("regions", parameters.regions);
  io.object("synthesis", parameters.synthesis);
  io.object("maps", parameters.maps);
  io.object("ageing", parameters.ageing);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<Vein> vein) {
  io.number("order", vein.order, 1, 100);
  io.number("parent", vein.parent, -1, 1e6);
  io.points("points", vein.points);
  io.number("startWidth", vein.startWidth, 0, 1e5);
  io.number("endWidth", vein.endWidth, 0, 1e5);
}

/// `entry`: the picture's file.
template <class Io>
void fields(Io& io, typename Io::template Ref<Variant> variant, const QString& entry) {
  io.seed("seed", variant.seed);
  io.flag("keep", variant.keep);
  io.image("image", variant.image, entry, QImage::Format_RGBA8888);
  io.point("root", variant.root);
  io.point("tip", variant.tip);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<Leaf> leaf) {
  io.id("id", leaf.id);
  const QString folder = QStringLiteral("leaves/%1/").arg(leaf.id.value);
  io.text("name", leaf.name);
  io.source("photo", leaf.photo, folder + QStringLiteral("photo"));
  io.image("mask", leaf.mask, folder + QStringLiteral("mask.png"), QImage::Format_Grayscale8);
  io.point("root", leaf.root);
  io.points("tips", leaf.tips);
  io.list("veins", leaf.veins, 100'000);
  io.points("markers", leaf.markers);
  io.object("ruler", leaf.ruler);
  io.ids("examples", leaf.examples);
  io.list("regionPairs", leaf.regionPairs, 10'000);
  io.number("bladeLength", leaf.bladeLength, 1e-4, 100);
  io.object("parameters", leaf.parameters);
  io.list("variants", leaf.variants, 9'999, [&folder](size_t i) {
    return QStringLiteral("%1variants/%2.png").arg(folder).arg(i + 1, 4, 10, QLatin1Char('0'));
  });
}

template <class Io>
void fields(Io& io, typename Io::template Ref<GrowerSettings> grower) {
  io.number("method", grower.method, 0, 3);
  io.seed("seed", grower.seed);
  io.number("height", grower.height, 0.01, 200);
  io.number("baseRadius", grower.baseRadius, 1e-4, 50);
  io.number("limbs", grower.limbs, 0, 2000);
  io.number("levels", grower.levels, 1, 8);
  io.number("spread", grower.spread, 0, 180);
  io.number("age", grower.age, 0, 1e4);
  io.number("maturity", grower.maturity, 0.1, 1e4);
  io.object("colonization", grower.colonization);
  io.object("selfOrganizing", grower.selfOrganizing);
  io.object("lSystem", grower.lSystem);
  io.object("foliage", grower.foliage);
  io.object("wood", grower.wood);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<LinkAttributes> link) {
  io.number("stiffness", link.stiffness, 0, 1e9);
  io.number("damping", link.damping, 0, 1e9);
  io.number("windResponse", link.windResponse, 0, 1e9);
  io.number("woodDensity", link.woodDensity, 1, 1e5);
  io.number("youngsModulus", link.youngsModulus, 1, 1e14);
  io.number("rayleighAlpha", link.rayleighAlpha, 0, 1e6);
  io.number("rayleighBeta", link.rayleighBeta, 0, 1e6);
  io.number("propagation", link.propagation, 0, 1);
  io.flag("pinned", link.pinned);
}

/// `entry`: the file of its keys.
template <class Io>
void fields(Io& io, typename Io::template Ref<Clip> clip, const QString& entry) {
  io.text("name", clip.name);
  io.number("length", clip.length, 0, 1e5);
  io.number("rate", clip.rate, 0.01, 1e4);
  io.flag("looping", clip.looping);
  QByteArray keys = packTracks(clip.tracks);
  io.bytes("keys", keys, entry);
  if constexpr (!std::is_const_v<std::remove_reference_t<decltype(clip)>>) {
    if (!io.failed() && !unpackTracks(keys, clip.tracks)) {
      io.fail(io.inside("keys"), QStringLiteral("are no keys of a clip"));
    }
  }
}

template <class Io>
void fields(Io& io, typename Io::template Ref<ChainSettings> chains) {
  io.choice("rule", chains.rule, 1);
  io.number("angle", chains.angle, 0, 1e3);
  io.number("length", chains.length, 0, 1e3);
  io.number("thickness", chains.thickness, 0, 1e3);
  io.number("order", chains.order, 0, 1e3);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<SurfaceSettings> surface) {
  io.number("scale", surface.scale, 1e-4, 1e4);
  io.flag("fromSkeleton", surface.fromSkeleton);
  io.object("chains", surface.chains);
  io.choice("curve", surface.curve, 1);
  io.number("detail", surface.detail, 0, 1);
  io.choice("bark", surface.bark, 5);
  io.number("tile", surface.tile, 1e-3, 100);
  io.number("flare", surface.flare, 0, 1.5);
  io.number("lobes", surface.lobes, 0, 9);
  io.number("gnarl", surface.gnarl, 0, 0.6);
  io.flag("roots", surface.roots);
  io.flag("followsState", surface.followsState);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<Plant> plant) {
  io.id("id", plant.id);
  io.text("name", plant.name);
  io.source("source", plant.file, QStringLiteral("plants/%1/source").arg(plant.id.value));
  io.object("grower", plant.grower);
  io.source("crown", plant.crown, QStringLiteral("plants/%1/crown").arg(plant.id.value));
  io.list("handEdits", plant.handEdits, 10'000);
  io.table("edits", plant.edits, 1'000'000);
  io.ids("leaves", plant.leaves);
  io.number("leafDensity", plant.leafDensity, 0, 1000);
  io.list("clips", plant.clips, 9'999, [&plant](size_t i) {
    return QStringLiteral("plants/%1/clips/%2.bin").arg(plant.id.value).arg(i + 1, 4, 10, QLatin1Char('0'));
  });
  io.object("surface", plant.surface);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<TreePlacement> tree) {
  io.id("id", tree.id);
  io.text("name", tree.name);
  io.id("plant", tree.plant);
  io.vector("position", tree.position);
  io.number("heading", tree.heading, -kFarthest, kFarthest);
  io.number("scale", tree.scale, 1e-4, 1e4);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<sim::WindKey> key) {
  io.number("time", key.time, 0, 1e7);
  io.number("strength", key.strength, 0, 1000);
  io.number("turn", key.turn, -kFarthest, kFarthest);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<sim::WindRecord> row) {
  io.number("time", row.time, 0, 1e9);
  io.number("speed", row.speed, 0, 200);
  io.number("heading", row.heading, -360, 720);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<sim::Fan> fan) {
  io.vector("position", fan.position);
  io.vector("direction", fan.direction);
  io.number("strength", fan.strength, 0, 200);
  io.number("radius", fan.radius, 0.01, 100);
  io.number("spread", fan.spread, 0, 60);
  io.flag("on", fan.on);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<sim::WindSettings> wind) {
  io.number("speed", wind.speed, 0, 200);
  io.vector("direction", wind.direction);
  io.number("turbulence", wind.turbulence, 0, 10);
  io.number("gustStrength", wind.gustStrength, 0, 10);
  io.number("gustPeriod", wind.gustPeriod, 0.01, 1e6);
  io.number("until", wind.until, 0, 1e38);
  io.seed("seed", wind.seed);
  io.number("canopyHeight", wind.canopyHeight, 0, 200);
  io.number("shelter", wind.shelter, 0, 1);
  auto course = static_cast<std::int32_t>(wind.course);
  io.number("course", course, 0, 2);
  QString recordName = QString::fromStdString(wind.recordName);
  io.text("recordName", recordName);
  io.flag("repeat", wind.repeat);
  io.list("curve", wind.curve, 10'000);
  io.list("records", wind.records, 200'000);
  io.list("fans", wind.fans, 1000);
  if constexpr (!std::is_const_v<std::remove_reference_t<decltype(wind)>>) {
    wind.course = static_cast<sim::WindCourse>(course);
    wind.recordName = recordName.toStdString();
  }
}

template <class Io>
void fields(Io& io, typename Io::template Ref<sim::LeafSettings> leaves) {
  io.number("count", leaves.count, kEveryLeaf, 50'000'000);
  io.number("season", leaves.season, 0, 1);
  io.number("spawnHeight", leaves.spawnHeight, 0, 1e5);
  io.number("massPerArea", leaves.massPerArea, 1e-4, 100);
  io.flag("respawn", leaves.respawn);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<sim::SolverSettings> solver) {
  io.number("step", solver.step, 1e-5, 1);
  io.number("structuralDamping", solver.structuralDamping, 0, 100);
  auto method = static_cast<std::int32_t>(solver.method);
  io.number("method", method, 0, 3);
  io.flag("axisMotion", solver.axisMotion);
  if constexpr (!std::is_const_v<std::remove_reference_t<decltype(solver)>>) {
    solver.method = static_cast<sim::TreeMethod>(method);
  }
}

template <class Io>
void fields(Io& io, typename Io::template Ref<Light> light) {
  io.number("azimuth", light.azimuth, -kFarthest, kFarthest);
  io.number("elevation", light.elevation, -90, 90);
  io.number("strength", light.strength, 0, 1000);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<DetailSettings> detail) {
  io.flag("adaptive", detail.adaptive);
  io.number("tolerance", detail.tolerance, 0.1, 4);
  io.flag("cards", detail.cards);
  io.number("cardsBelow", detail.cardsBelow, 0.1, 10);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<Scene> scene) {
  io.list("trees", scene.trees, 100'000);
  io.object("wind", scene.wind);
  io.object("leaves", scene.leaves);
  io.object("solver", scene.solver);
  io.object("light", scene.light);
  io.object("detail", scene.detail);
  io.seed("seed", scene.seed);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<SimulationState> simulation) {
  io.number("time", simulation.time, 0, 1e12);
  io.bytes("state", simulation.bytes, QStringLiteral("simulation/state.bin"));
}

template <class Io>
void fields(Io& io, typename Io::template Ref<Camera> camera) {
  io.vector("target", camera.target);
  io.number("azimuth", camera.azimuth, -kFarthest, kFarthest);
  io.number("elevation", camera.elevation, -90, 90);
  io.number("distance", camera.distance, 1e-3, kFarthest);
  io.number("fieldOfView", camera.fieldOfView, 1, 179);
}

template <class Io>
void fields(Io& io, typename Io::template Ref<ViewState> view) {
  io.text("workspace", view.workspace);
  io.object("camera", view.camera);
  io.json("layout", view.layout);
}

}  // namespace windfall::model
