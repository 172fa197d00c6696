// A small project in which no field has its default value.
#pragma once

#include <QBuffer>
#include <QImage>
#include <QJsonArray>

#include "model/document/project.h"

namespace windfall::test {

inline QImage noisePicture(QSize size, QImage::Format format, quint32 seed) {
  QImage image(size, format);
  quint32 state = seed * 2654435761U + 1;
  for (int y = 0; y < size.height(); ++y) {
    uchar* row = image.scanLine(y);
    for (qsizetype i = 0; i < size.width() * qsizetype(image.depth() / 8); ++i) {
      state = state * 1664525U + 1013904223U;
      row[i] = static_cast<uchar>(state >> 24);
    }
  }
  return image;
}

inline model::SourceFile pngSource(const QString& name, QSize size) {
  model::SourceFile file{name, {}};
  QBuffer buffer(&file.bytes);
  buffer.open(QIODevice::WriteOnly);
  noisePicture(size, QImage::Format_RGBA8888, 5).save(&buffer, "png");
  return file;
}

inline model::Project richProject() {
  using namespace model;
  Project project;
  Leaf leaf;
  leaf.id = {3};
  leaf.name = QStringLiteral("Břek “č. 1”");
  leaf.photo = pngSource(QStringLiteral("Žlutý list.PNG"), {40, 30});
  leaf.mask = noisePicture({40, 30}, QImage::Format_Grayscale8, 1);
  leaf.root = QPointF(12.1, 1.0 / 3);
  leaf.veins = {{1, -1, {{1, 2}, {3.7, 4.1}}, 4.2, 0.7}, {2, 0, {{5, 6}, {7, 8}, {9, 1e-9}}, 2, 1}};
  leaf.markers = {{3, 4}, {5.5, 6.25}};
  leaf.bladeLength = 0.123456789012345;
  leaf.tips = {{2, 29.5}, {0.1, 20}};
  leaf.ruler = {QPointF(1, 1.5), QPointF(30, 2), 0.17};
  leaf.examples = {{4}, {3}};
  leaf.regionPairs = {{{3, 4}, {4}, {5, 6.5}}, {{7, 8}, {}, {9, 10}}};
  LeafParameters& parameters = leaf.parameters;
  parameters.mask.keepHoles = false;
  parameters.epsilon = 2.5;
  parameters.shape = {true, 0.2, 0.3, 0.05, 0.01, 31, 2, 3};
  parameters.veins = {
      18446744073709551615ULL, true, 0.01, 5, 11, 70.1, 30.2, 5, 0.1, 0.7, 0.5, false, false, true, true, false, 0.03};
  parameters.costs = {2, 5, 9};
  parameters.regions = {false, 0.4, false, true, 12, 0.8};
  parameters.synthesis = {false, 512, 300, 1000, 2, 5, 3, 0.1, false, true, 7.5};
  parameters.maps = {0.5, 0.9, 0.1, 1.5};
  parameters.ageing = {0.4, 3.5, 0.9, 0.8, 0.6};
  project.atlas = {4096, 32, 3, true, AtlasPacker::Unity, 700};
  leaf.variants = {
      {9007199254740993ULL, false, noisePicture({17, 23}, QImage::Format_RGBA8888, 2), QPointF(8, 22), QPointF(9.5, 1)},
      {7, true, QImage()}};
  Leaf bare;
  bare.id = {4};
  bare.name = QStringLiteral("Bare");
  project.leaves = {leaf, bare};

  Plant grown;
  grown.id = {5};
  grown.name = QStringLiteral("Grown");
  grown.grower = GrowerSettings{77, 12.5, 0.2, 30, 2, 44.4};
  grown.grower->method = GrowMethod::SelfOrganizing;
  grown.grower->age = 33;
  grown.grower->colonization.crown.profile = {{0.2, 0}, {1, 0.5}, {-0.7, 0.6}, {0, 1}};
  grown.grower->selfOrganizing.model = ResourceModel::Combined;
  grown.grower->selfOrganizing.sprays = true;
  grown.grower->lSystem.rules = QStringLiteral("axiom: F\nF -> F[+F]F // \u00e4\n");
  grown.grower->foliage.look = LeafLook::Willow;
  grown.grower->wood.bark = BarkLook::Pine;
  grown.crown = {QStringLiteral("crown.obj"), QByteArray("v 0 0 0\n")};
  HandEdit drawn;
  drawn.kind = HandEditKind::Draw;
  drawn.node = 12;
  drawn.place = {0, 2, 0.5f};
  drawn.age = 30;
  drawn.line = {{0, 2.5f, 1}, {0, 3, 1.5f}};
  drawn.part = {{{0, 0, 0}, -1, 0.02}, {{0, 1, 0}, 0, 0.01}};
  grown.handEdits = {HandEdit(), drawn};
  grown.edits[QStringLiteral("trunk/1 \"quoted\"")] = {2, 3, 4, 700, 1.1e10};
  grown.edits[QString()] = {1, 1, 0.1, 950, 6e9};
  grown.leaves = {{4}, {3}};
  grown.leafDensity = 0.3;
  Plant file;
  file.id = {6};
  file.name = QStringLiteral("From file");
  file.surface.scale = 1.5;
  file.surface.fromSkeleton = true;
  file.surface.chains = {ChainRule::Longest, 0.1, 0.2, 0.3, 0.4};
  file.surface.curve = CurveKind::BSpline;
  file.surface.bark = BarkKind::Pine;
  file.surface.lobes = 3;
  file.surface.roots = false;
  file.file = {QStringLiteral("birch.FBX"), QByteArrayLiteral("not a real tree \0\xff")};
  project.plants = {grown, file};

  project.scene.trees = {{{7}, "One", {5}, {0.1f, 0, -3.3f}, 12.5, 1.25}, {{8}, "Two", {6}, {1, 2, 3}, -90, 0.5}};
  project.scene.wind = {12.7f, {0.6f, 0, 0.8f}, 0.33f, 1.1f, 4.2f, 60, 99};
  project.scene.leaves = {12345, 0.9f, 25.5f, 0.08f, true};
  project.scene.solver = {1.f / 120, 0.05f};
  project.scene.light = {200.2, 12.3, 1.5};
  project.scene.detail = {true, 0.75, false, 2.5};
  project.scene.seed = 18446744073709551614ULL;
  project.simulation = {17.1, QByteArrayLiteral("\0\1\2 state of links and leaves")};
  project.view.workspace = QStringLiteral("leaf");
  project.view.camera = {{1, 2.5f, 3}, -10, 20.5, 30.1, 50};
  project.view.layout = {{"docks", "AAAA/w=="}, {"zoom", 1.1}, {"open", QJsonArray{"leaf", 3}}};
  project.nextId = 42;
  return project;
}

}  // namespace windfall::test
