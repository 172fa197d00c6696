// Sky and ground, and the size of the picture.
#include <doctest/doctest.h>

#include "support/render_stage.h"

using namespace windfall;

TEST_CASE("an empty scene is sky above and ground below") {
  test::Stage stage(160, 96);
  WINDFALL_NEEDS_OPENGL(stage);
  stage.view.eye = {0, 3, 12};
  stage.view.target = {0, 3, 0};
  const render::Picture picture = stage.draw();
  const vec3 sky = test::meanColor(picture, 0, 0, 160, 16), ground = test::meanColor(picture, 0, 76, 160, 96);
  CAPTURE(sky.x);
  CAPTURE(sky.z);
  CHECK(sky.z > sky.x + 8);         // blue
  CHECK(ground.y > ground.z + 15);  // grass
  CHECK(test::brightness(sky) > 60);
  CHECK(test::brightness(sky) < 245);
  test::keep(picture, "render_background");
}

TEST_CASE("the sky has no visible steps") {
  test::Stage stage(64, 256);
  WINDFALL_NEEDS_OPENGL(stage);
  stage.view.eye = {0, 3, 12};
  stage.view.target = {0, 12, 0};
  const render::Picture picture = stage.draw();
  float before = test::brightness(test::meanColor(picture, 0, 0, 64, 1));
  for (int y = 1; y < 100; ++y) {
    const float now = test::brightness(test::meanColor(picture, 0, y, 64, y + 1));
    CHECK(std::abs(now - before) < 4);
    before = now;
  }
}

TEST_CASE("a picture of another size shows the same view") {
  test::Stage stage(160, 96);
  WINDFALL_NEEDS_OPENGL(stage);
  const render::Picture small = stage.draw();
  REQUIRE(bool(stage.context->resize(320, 192)));
  stage.view.width = 320;
  stage.view.height = 192;
  const render::Picture large = stage.draw();
  CHECK(large.width == 320);
  CHECK(large.rgba.size() == 320u * 192u * 4u);
  const vec3 a = test::meanColor(small, 0, 0, 160, 40), b = test::meanColor(large, 0, 0, 320, 80);
  CHECK(std::abs(test::brightness(a) - test::brightness(b)) < 3);
}

TEST_CASE("a picture larger than the device allows is refused with its size") {
  test::Stage stage(16, 16);
  WINDFALL_NEEDS_OPENGL(stage);
  const Status refused = stage.context->resize(200'000, 10);
  REQUIRE_FALSE(bool(refused));
  CHECK(refused.error().message.find("200000x10") != std::string::npos);
}

TEST_CASE("a picture of high quality has grass, without specks") {
  test::Stage stage(240, 135);
  WINDFALL_NEEDS_OPENGL(stage);
  stage.view.eye = {0, 1.2f, 5};
  stage.view.target = {0, 0.6f, 0};
  const render::Picture bare = stage.draw();
  const int calls = stage.renderer->lastDraw().calls;
  stage.view.quality = render::Quality::High;
  const render::Picture grown = stage.draw();
  CHECK(stage.renderer->lastDraw().calls == calls + 1);
  int changed = 0, black = 0;
  for (int y = 70; y < 135; ++y) {
    for (int x = 0; x < 240; ++x) {
      const float now = test::brightness(test::meanColor(grown, x, y, x + 1, y + 1));
      changed += std::abs(now - test::brightness(test::meanColor(bare, x, y, x + 1, y + 1))) > 6 ? 1 : 0;
      black += now < 4 ? 1 : 0;
    }
  }
  CHECK(changed > 1500);
  CHECK(black == 0);
  if (black != 0) test::keep(grown, "render_grass");
}
