// SPDX-License-Identifier: BSD-3-Clause
#include "decode_png.h"
#include "run_tool.h"
#include "tool_clouds.h"

#include <gtest/gtest.h>

namespace pcl_gpf::test {
namespace {

/** Runs render with a small picture and decodes it. */
Picture
render(const TemporaryFolder& folder, std::vector<std::string> words)
{
  const std::vector<std::string> common{"-o", folder / "picture.png", "--overwrite", "--width", "120", "--height", "100"};
  words.insert(words.begin(), "render");
  words.insert(words.end(), common.begin(), common.end());
  const ToolRun run = runTool(words);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return decodePng(readBytes(folder / "picture.png"));
}

TEST(RenderCommand, drawsAPictureOfTheSizeAskedFor)
{
  const TemporaryFolder folder;
  const Picture picture = render(folder, {saveNoisyCube(folder / "a.pcd")});
  EXPECT_EQ(picture.width, 120u);
  EXPECT_EQ(picture.height, 100u);
  EXPECT_GT(picture.drawnPixels(), 120u * 100u / 4);
  EXPECT_LT(picture.drawnPixels(), 120u * 100u * 3 / 4); // and a margin around it
}

TEST(RenderCommand, putsCloudsSideBySideInOneFrame)
{
  const TemporaryFolder folder;
  const std::string path = saveNoisyCube(folder / "a.pcd");
  const Picture picture = render(folder, {path, path, "--labels", "none"});
  EXPECT_EQ(picture.height, 100u);
  ASSERT_GT(picture.width, 240u);
  const std::size_t second = picture.width - 120;
  for (std::size_t row = 0; row < 100; ++row)
    for (std::size_t i = 0; i < 3 * 120; ++i)
      ASSERT_EQ(picture.rgb[3 * picture.width * row + i], picture.rgb[3 * (picture.width * row + second) + i]);
  EXPECT_GT(render(folder, {path, path, "--labels", "before,after"}).height, 100u);
}

TEST(RenderCommand, repeatsTheBytesForAnyNumberOfThreads)
{
  const TemporaryFolder folder;
  const std::string path = saveNoisyCube(folder / "a.pcd");
  render(folder, {path, "--threads", "1"});
  const std::string bytes = readBytes(folder / "picture.png");
  render(folder, {path, "--threads", "3"});
  EXPECT_EQ(readBytes(folder / "picture.png"), bytes);
}

TEST(RenderCommand, aSectionOfACubeIsTheOutlineOfASquare)
{
  const TemporaryFolder folder;
  save(toCloudFile(cube(20000, 0.0, 5)), folder / "a.pcd");
  const Picture picture = render(folder, {folder / "a.pcd", "--section", "z"});
  const auto drawn = [&](std::size_t column, std::size_t row) { return picture.rgb[3 * (picture.width * row + column)] != picture.rgb[0]; };
  std::size_t in_middle = 0;
  for (std::size_t row = 30; row < 70; ++row)
    for (std::size_t column = 40; column < 80; ++column)
      in_middle += drawn(column, row);
  EXPECT_EQ(in_middle, 0u);
  EXPECT_GT(picture.drawnPixels(), 150u);
}

TEST(RenderCommand, coloursByRgbAndByField)
{
  const TemporaryFolder folder;
  CloudFile cloud = toCloudFile(cube(3000, 0.0, 5));
  for (const char* name : {"red", "green", "blue"})
    cloud.addField(name, FieldType::UInt8);
  cloud.setColumn(cloud.findField("red"), std::vector<double>(cloud.size(), 255.0));
  save(cloud, folder / "a.ply");
  save(cloud, folder / "a.pcd"); // holds them packed
  for (const char* name : {"a.ply", "a.pcd"}) {
    const Picture picture = render(folder, {folder / name, "--color", "rgb"});
    const std::size_t middle = 3 * (120 * 50 + 60);
    EXPECT_GT(picture.rgb[middle], 100);
    EXPECT_EQ(picture.rgb[middle + 1], 0);
    EXPECT_EQ(picture.rgb[middle + 2], 0);
  }
  const Picture by_height = render(folder, {folder / "a.ply", "--color", "z", "--low", "0", "--high", "1"});
  EXPECT_GT(by_height.height, 100u); // a legend below
  EXPECT_EQ(runTool({"render", folder / "a.ply", "-o", folder / "b.png", "--color", "nothing"}).exit_code, 5);
}

TEST(RenderCommand, zoomsAndCrops)
{
  const TemporaryFolder folder;
  const std::string path = saveNoisyCube(folder / "a.pcd", 20000, 0.0);
  // The middle of the top, close: nothing but the top.
  const Picture close = render(folder, {path, "--view", "0,0,1", "--zoom", "8", "--center", "0.5,0.5,1"});
  for (std::size_t corner : {0u, 119u, 120u * 99u, 120u * 100u - 1})
    EXPECT_LT(close.rgb[3 * corner], 240);
  const std::size_t whole = render(folder, {path, "--view", "0,0,1", "--center", "0.5,0.5,0.5"}).drawnPixels();
  const std::size_t half = render(folder, {path, "--view", "0,0,1", "--crop-max", "0.5,1,1"}).drawnPixels();
  EXPECT_GT(whole, 6000u);
  EXPECT_LT(half, whole * 7 / 10);
}

TEST(RenderCommand, drawsOnePointAndSkipsNaN)
{
  const TemporaryFolder folder;
  CloudFile cloud = toCloudFile(cube(2, 0.0, 5));
  cloud.setCoordinate(0, 0, std::numeric_limits<double>::quiet_NaN());
  save(cloud, folder / "a.pcd");
  const Picture picture = render(folder, {folder / "a.pcd"});
  EXPECT_GT(picture.drawnPixels(), 0u);
  EXPECT_LT(picture.drawnPixels(), 20u);
}

TEST(RenderCommand, drawsUtmCoordinatesAsTheLocalOnes)
{
  const TemporaryFolder folder;
  const Shape shape = cube(3000, 0.0, 5);
  save(toCloudFile(shape, FieldType::Float64), folder / "local.pcd");
  save(toCloudFile(shape, FieldType::Float64, {500000, 5500000, 100}), folder / "utm.pcd");
  const Picture local = render(folder, {folder / "local.pcd"});
  const Picture utm = render(folder, {folder / "utm.pcd"});
  std::size_t different = 0;
  for (std::size_t i = 0; i < local.rgb.size(); ++i)
    different += local.rgb[i] != utm.rgb[i];
  EXPECT_LT(different, local.rgb.size() / 100); // the last bits of the coordinates differ
}

TEST(RenderCommand, exitCodes)
{
  const TemporaryFolder folder;
  const std::string path = saveNoisyCube(folder / "a.pcd");
  save(toCloudFile(Shape{}), folder / "empty.pcd");
  writeBytes(folder / "there.png", "x");
  const auto code = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "render");
    return runTool(words).exit_code;
  };
  EXPECT_EQ(code({path}), 2);
  EXPECT_EQ(code({path, "-o", folder / "x.png", "--view", "0,0,0"}), 2);
  EXPECT_EQ(code({path, "-o", folder / "x.png", "--section", "z", "--view", "1,0,0"}), 2);
  EXPECT_EQ(code({folder / "none.pcd", "-o", folder / "x.png"}), 3);
  EXPECT_EQ(code({path, "-o", folder / "there.png"}), 4);
  EXPECT_EQ(code({folder / "empty.pcd", "-o", folder / "x.png"}), 5);
  EXPECT_EQ(code({path, "-o", folder / "x.png", "--crop-min", "2,2,2", "--crop-max", "3,3,3"}), 5);
  EXPECT_EQ(code({path, "-o", folder / "x.png", "--normals", "file"}), 5);
  EXPECT_EQ(readBytes(folder / "there.png"), "x");
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"a.pcd", "empty.pcd", "there.png"}));
}

TEST(RenderCommand, drawsARawScan)
{
  const std::string scan = PCL_GPF_SHARED_DIR "/data/raw/stanford_bun000_range.ply";
  if (readBytes(scan).empty())
    GTEST_SKIP() << "no " << scan;
  const TemporaryFolder folder;
  EXPECT_GT(render(folder, {scan, "--view", "0,0,1", "--up", "0,1,0"}).drawnPixels(), 2500u);
}

TEST(RenderCommand, aPointFarAwayDoesNotHideTheOthers)
{
  const TemporaryFolder folder;
  Shape shape = cube(500, 0.0, 5);
  save(toCloudFile(shape), folder / "near.pcd");
  const std::size_t near = render(folder, {folder / "near.pcd"}).drawnPixels();
  for (const double away : {1e3, 1e9}) {
    shape.points.back() = {away, 0, 0};
    save(toCloudFile(shape), folder / "stray.pcd");
    EXPECT_NEAR(static_cast<double>(render(folder, {folder / "stray.pcd"}).drawnPixels()), static_cast<double>(near), 0.05 * static_cast<double>(near)) << away;
  }
}

} // namespace
} // namespace pcl_gpf::test
