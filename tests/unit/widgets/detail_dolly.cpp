// A slow ride away from a plant: adaptive wood changes from picture to picture as the finest mesh does, and never
// jumps.
#include <QtTest>
#include <cmath>

#include "model/plant/sample_skeleton.h"
#include "support/suite.h"
#include "widgets/render/detail_stage.h"
#include "widgets/render/offscreen_context.h"
#include "widgets/viewport/detail_bench_scene.h"

using namespace windfall;
using namespace windfall::widgets;

class DetailDollyTest : public QObject {
  Q_OBJECT
 private slots:
  void nothingJumpsFromPictureToPicture() {
    auto context = render::OffscreenContext::create(16, 16);
    if (!context) QSKIP(context.error().message.c_str());
    BenchScene scene;
    scene.trees = 1;
    scene.plants.push_back(makeBenchPlant(model::sampleSkeleton(2), 1e-3f));
    const std::vector<double> finest = changes(scene, BenchMesh::Uniform),
                              adaptive = changes(scene, BenchMesh::Adaptive);
    QVERIFY(!finest.empty() && finest.size() == adaptive.size());
    for (std::size_t i = 0; i < finest.size(); ++i) {
      QVERIFY2(adaptive[i] < 1.06 * finest[i] + 0.01,
               qPrintable(QStringLiteral("picture %1 changes by %2, the finest mesh's by %3")
                              .arg(i + 1)
                              .arg(adaptive[i])
                              .arg(finest[i])));
    }
  }

 private:
  /// How much each picture of the ride differs from the one before: mean over the pixels, 0..255.
  static std::vector<double> changes(const BenchScene& scene, BenchMesh mesh) {
    constexpr int kWidth = 480, kHeight = 320, kPictures = 110;
    auto stage = render::DetailStage::create(kWidth, kHeight);
    if (!stage || !(*stage)->setContent(scene.content(mesh))) return {};
    const std::vector<mat4> bones = scene.pose(0);
    std::vector<double> changes;
    render::Picture before;
    for (int i = 0; i < kPictures; ++i) {
      render::View view;
      const vec3 middle = BenchScene::place(0) + vec3(0, 0.4f, 0);
      const auto distance = static_cast<float>(0.8 * std::pow(1.02, i));
      view.target = middle;
      view.eye = middle + vec3(0.1f, 0.05f, 1) * distance;
      view.tolerance = 0.5f;
      (*stage)->draw(view, bones, mesh == BenchMesh::Adaptive, true);
      render::Picture picture = (*stage)->read();
      if (i > 0) {
        double sum = 0;
        for (std::size_t k = 0; k < picture.rgba.size(); ++k)
          sum += std::abs(int{picture.rgba[k]} - int{before.rgba[k]});
        changes.push_back(sum / static_cast<double>(picture.rgba.size()));
      }
      before = std::move(picture);
    }
    return changes;
  }
};

WINDFALL_SUITE(DetailDollyTest)
#include "detail_dolly.moc"
