// SPDX-License-Identifier: BSD-3-Clause
#include "decode_png.h"
#include "render/camera.h"
#include "render/color_map.h"
#include "render/image.h"
#include "render/splats.h"
#include "render/text.h"

#include <pcl_gpf/core/sampling.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace pcl_gpf::test {
namespace {

constexpr Color kWhite{1, 1, 1};
constexpr Color kBlack{0, 0, 0};

Camera
cameraOf(std::size_t size, double pixels_per_unit)
{
  Camera camera;
  camera.width = camera.height = size;
  camera.pixels_per_unit = pixels_per_unit;
  return camera;
}

SplatCloud
discs(std::vector<Position> points, double radius, std::vector<Position> normals = {})
{
  SplatCloud cloud;
  cloud.colors.assign(points.size(), kBlack);
  cloud.points = std::move(points);
  cloud.normals = std::move(normals);
  cloud.radius = radius;
  return cloud;
}

std::size_t
pixelsOf(const VisibleSplats& visible, std::uint32_t point)
{
  return static_cast<std::size_t>(std::count(visible.point.begin(), visible.point.end(), point));
}

TEST(Camera, viewsAreOrthonormalAndRightHanded)
{
  SplitMix64 random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Position toward{random.normal(), random.normal(), random.normal()};
    const Position up = trial % 2 ? Position{random.normal(), random.normal(), random.normal()} : toward; // also parallel
    const View view = makeView(toward, up);
    EXPECT_NEAR(dot(view.toward, normalized(toward)), 1.0, 1e-12);
    EXPECT_NEAR(length(view.right), 1.0, 1e-12);
    EXPECT_NEAR(length(view.up), 1.0, 1e-12);
    EXPECT_NEAR(dot(cross(view.right, view.up), view.toward), 1.0, 1e-12);
    EXPECT_GE(dot(view.up, up), -1e-12);
  }
}

TEST(Camera, aFittedCameraShowsAllPointsButTheOutermost)
{
  SplitMix64 random(2);
  std::vector<Position> points(5000);
  for (Position& point : points)
    point = {5500000 + random.uniform(), 2 * random.uniform(), 3 * random.uniform()};
  points[17] = {5500000 + 400, 0, 0}; // an outlier must not shrink the rest to a dot
  const Camera camera = fitCamera(makeView({0.5, -1, 0.6}, {0, 0, 1}), points, 400, 300);
  std::size_t shown = 0;
  double lowest = 300, highest = 0;
  for (const Position& point : points) {
    const Position pixel = camera.project(point);
    const bool inside = pixel[0] >= 0 && pixel[0] < 400 && pixel[1] >= 0 && pixel[1] < 300;
    shown += inside;
    if (inside) {
      lowest = std::min(lowest, pixel[1]);
      highest = std::max(highest, pixel[1]);
    }
  }
  EXPECT_EQ(shown, points.size() - 1);
  EXPECT_GT(highest - lowest, 0.8 * 300);
}

TEST(Camera, automaticViewStandsWhereTheSensorStands)
{
  BoundingBox box;
  box.add(-1, -1, 2);
  box.add(1, 1, 4);
  const View from_sensor = automaticView(box, {0, 0, 0});
  EXPECT_LT(from_sensor.toward[2], -0.8);
  EXPECT_LT(from_sensor.up[1], -0.8); // a camera's y points down
  const View around = automaticView(box, {0, 0, 3});
  EXPECT_GT(around.up[2], 0.5);
  EXPECT_GT(around.toward[2], 0.3);
}

TEST(Splats, aDiscHasItsArea)
{
  const VisibleSplats flat = drawSplats(discs({{0, 0, 0}}, 20), cameraOf(100, 1), 1);
  EXPECT_NEAR(static_cast<double>(pixelsOf(flat, 0)), 3.14159265 * 400, 30);
  const VisibleSplats tilted = drawSplats(discs({{0, 0, 0}}, 20, {normalized({1, 0, 1})}), cameraOf(100, 1), 1);
  EXPECT_NEAR(static_cast<double>(pixelsOf(tilted, 0)), 3.14159265 * 400 * std::sqrt(0.5), 30);
}

TEST(Splats, aTiltedDiscComesNearerOnOneSide)
{
  const VisibleSplats visible = drawSplats(discs({{0, 0, 0}}, 20, {normalized({-1, 0, 1})}), cameraOf(100, 1), 1);
  EXPECT_GT(visible.depth[100 * 50 + 60], visible.depth[100 * 50 + 40]); // facing left: the right side is nearer
}

TEST(Splats, theNearerDiscHidesTheOther)
{
  const VisibleSplats visible = drawSplats(discs({{0, 0, 1}, {0, 0, 5}, {0, 0, 3}}, 10), cameraOf(50, 1), 1);
  EXPECT_EQ(pixelsOf(visible, 0), 0u);
  EXPECT_GT(pixelsOf(visible, 1), 250u);
  EXPECT_EQ(pixelsOf(visible, 2), 0u);
}

TEST(Splats, noPointIsTooSmallToBeSeen)
{
  SplitMix64 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Position anywhere{20 * (random.uniform() - 0.5), 20 * (random.uniform() - 0.5), 0};
    const Position edge_on{1, 0, 0};
    EXPECT_GT(pixelsOf(drawSplats(discs({anywhere}, 1e-9), cameraOf(40, 1), 1), 0), 0u);
    EXPECT_GT(pixelsOf(drawSplats(discs({anywhere}, 5, {edge_on}), cameraOf(40, 1), 1), 0), 0u);
  }
}

TEST(Splats, pointsOutsideOfThePictureDoNoHarm)
{
  const double far = 1e12;
  const VisibleSplats visible =
      drawSplats(discs({{far, 0, 0}, {-far, 0, 0}, {0, far, 0}, {0, -far, 0}, {0, 0, 0}, {25, 25, 0}}, 3), cameraOf(50, 1), 1);
  for (std::uint32_t outside = 0; outside < 4; ++outside)
    EXPECT_EQ(pixelsOf(visible, outside), 0u);
  EXPECT_GT(pixelsOf(visible, 4), 20u);
  EXPECT_GT(pixelsOf(visible, 5), 0u); // cut by the corner
}

TEST(Splats, doNotDependOnTheThreads)
{
  SplitMix64 random(4);
  std::vector<Position> points(20000), normals(20000);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {random.normal(), random.normal(), random.normal()};
    normals[i] = normalized({random.normal(), random.normal(), random.normal()});
  }
  const SplatCloud cloud = discs(points, 0.05, normals);
  const Camera camera = cameraOf(200, 40);
  const VisibleSplats one = drawSplats(cloud, camera, 1);
  for (const std::size_t threads : {2u, 3u, 7u}) {
    const VisibleSplats many = drawSplats(cloud, camera, threads);
    EXPECT_EQ(many.point, one.point);
    EXPECT_EQ(many.depth, one.depth);
    EXPECT_EQ(shadeSplats(cloud, many, camera, kWhite, threads).pixels, shadeSplats(cloud, one, camera, kWhite, 1).pixels);
  }
}

TEST(Shading, doesNotDependOnTheSignOfTheNormals)
{
  SplatCloud cloud = discs({{0, 0, 0}}, 20, {normalized({0.3, 0.4, 0.8})});
  cloud.colors = {Color{0.8f, 0.8f, 0.8f}};
  const Camera camera = cameraOf(50, 1);
  const Image image = shadeSplats(cloud, drawSplats(cloud, camera, 1), camera, kWhite, 1);
  cloud.normals[0] = {-cloud.normals[0][0], -cloud.normals[0][1], -cloud.normals[0][2]};
  EXPECT_EQ(shadeSplats(cloud, drawSplats(cloud, camera, 1), camera, kWhite, 1).pixels, image.pixels);
}

TEST(Image, halvingAveragesFourPixels)
{
  Image image(4, 2, kBlack);
  image.at(0, 0) = kWhite;
  image.at(3, 1) = Color{0.4f, 0, 0};
  const Image half = halved(image);
  ASSERT_EQ(half.width, 2u);
  ASSERT_EQ(half.height, 1u);
  EXPECT_FLOAT_EQ(half.at(0, 0)[1], 0.25f);
  EXPECT_FLOAT_EQ(half.at(1, 0)[0], 0.1f);
}

TEST(Image, pngHoldsEveryPixel)
{
  Image image(7, 5, kBlack);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = {static_cast<float>(i) / 255, static_cast<float>(2 * i) / 255, 1.5f};
  const std::vector<unsigned char> png = encodePng(image);
  const Picture picture = decodePng(std::string(png.begin(), png.end()));
  ASSERT_EQ(picture.width, 7u);
  ASSERT_EQ(picture.height, 5u);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    EXPECT_EQ(picture.rgb[3 * i], i);
    EXPECT_EQ(picture.rgb[3 * i + 1], 2 * i);
    EXPECT_EQ(picture.rgb[3 * i + 2], 255); // clamped
  }
}

TEST(Text, isAsWideAsItSaysAndCutAtTheBorder)
{
  Image image(200, 40, kWhite);
  drawText("Hg%", 10, 5, kBlack, image);
  std::size_t left = 200, right = 0;
  for (std::size_t row = 0; row < 40; ++row)
    for (std::size_t column = 0; column < 200; ++column)
      if (image.at(column, row) == kBlack) {
        left = std::min(left, column);
        right = std::max(right, column);
        EXPECT_GE(row, 5u);
        EXPECT_LT(row, 5 + kTextHeight);
      }
  EXPECT_EQ(left, 10u);
  EXPECT_EQ(right, 10 + textWidth("Hg%") - 1);
  drawText("much too long for what is left of it", 150, 35, kBlack, image);
}

TEST(ColorMap, runsFromVioletToYellowAndNeverGetsDarker)
{
  const auto light = [](const Color& color) { return 0.3f * color[0] + 0.59f * color[1] + 0.11f * color[2]; };
  for (int i = 1; i <= 100; ++i)
    EXPECT_GE(light(mapColor(i / 100.0)), light(mapColor((i - 1) / 100.0)));
  EXPECT_EQ(mapColor(-5), mapColor(0));
  EXPECT_EQ(mapColor(5), mapColor(1));
  const Color grey = mapColor(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(grey[0], grey[1]);
}

} // namespace
} // namespace pcl_gpf::test
