// SPDX-License-Identifier: BSD-3-Clause
#include "../console.h"
#include "../option_groups.h"
#include "../render/coloring.h"
#include "../render/composition.h"
#include "../render/picture_cloud.h"
#include "../render/render_options.h"
#include "../render/splats.h"
#include "commands.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/io/atomic_file.h>

#include <algorithm>

namespace pcl_gpf {

namespace {

constexpr std::size_t kMostClouds = 8;
constexpr Color kClay{0.78f, 0.80f, 0.84f};   // of surfaces without a colour of their own
constexpr Color kDotInk{0.10f, 0.28f, 0.50f}; // of the points of a section

/** A point of a box, given as fractions of its sides. */
Position
pointOfBox(const BoundingBox& box, const Position& fractions)
{
  Position point;
  for (std::size_t axis = 0; axis < 3; ++axis)
    point[axis] = box.min[axis] + fractions[axis] * (box.max[axis] - box.min[axis]);
  return point;
}

/** Lengths such as 3x are read in the coarsest spacing of all clouds, so that they are the same length in each. */
CloudScale
commonScale(const std::vector<PictureCloud>& clouds)
{
  CloudScale scale;
  scale.diagonal = clouds[0].box.diagonal();
  for (const PictureCloud& cloud : clouds)
    scale.spacing = std::max(scale.spacing, cloud.spacing);
  return scale;
}

/** The normals of the files when all have them, else estimates for all: only like can be compared with like. */
void
setNormals(const Options& options, std::vector<PictureCloud>& clouds)
{
  const std::string& source = options.text("normals");
  const bool in_files = std::all_of(clouds.begin(), clouds.end(), hasUsableNormals);
  if (source == "file" && !in_files)
    throw UnsuitableData("--normals file: not every point of every cloud has a normal");
  const double radius = options.length("normal-radius").resolve(commonScale(clouds));
  for (PictureCloud& cloud : clouds) {
    if (in_files && source != "estimate")
      takeNormals(cloud);
    else if (radius > 0) // without two different points there is no spacing, and the discs face the viewer
      estimateNormals(cloud, radius, threadCount(options));
  }
}

void
cut(const Options& options, std::vector<PictureCloud>& clouds)
{
  const BoundingBox& box = clouds[0].box;
  if (options.given("crop-min") || options.given("crop-max")) {
    const Position low = pointOfBox(box, vectorOption(options, "crop-min"));
    const Position high = pointOfBox(box, vectorOption(options, "crop-max"));
    for (PictureCloud& cloud : clouds)
      keepOnly(cloud, [&](const Position& p) {
        return p[0] >= low[0] && p[1] >= low[1] && p[2] >= low[2] && p[0] <= high[0] && p[1] <= high[1] && p[2] <= high[2];
      });
  }
  if (isSection(options)) {
    const auto axis = static_cast<std::size_t>(options.text("section")[0] - 'x');
    const double at = box.min[axis] + options.number("section-at") * (box.max[axis] - box.min[axis]);
    const double reach = 0.5 * options.length("section-thickness").resolve(commonScale(clouds));
    for (PictureCloud& cloud : clouds)
      keepOnly(cloud, [&](const Position& p) { return std::abs(p[axis] - at) <= reach; });
  }
  if (std::all_of(clouds.begin(), clouds.end(), [](const PictureCloud& cloud) { return cloud.points.empty(); }))
    throw UnsuitableData("no point is left to show; move or enlarge the cut");
}

View
chooseView(const Options& options, const std::vector<PictureCloud>& clouds)
{
  if (isSection(options)) {
    const char axis = options.text("section")[0];
    const Position toward{axis == 'x' ? 1.0 : 0.0, axis == 'y' ? -1.0 : 0.0, axis == 'z' ? 1.0 : 0.0};
    return makeView(toward, axis == 'z' ? Position{0, 1, 0} : Position{0, 0, 1});
  }
  const std::array<double, 7>& viewpoint = clouds[0].file.viewpoint;
  const View automatic = automaticView(clouds[0].dense, {viewpoint[0], viewpoint[1], viewpoint[2]});
  if (!options.given("view") && !options.given("up"))
    return automatic;
  return makeView(options.given("view") ? vectorOption(options, "view") : automatic.toward,
                  options.given("up") ? vectorOption(options, "up") : Position{0, 0, 1});
}

/** One camera for all clouds, at twice the resolution of the picture. */
Camera
chooseCamera(const Options& options, const std::vector<PictureCloud>& clouds)
{
  std::vector<Position> all;
  for (const PictureCloud& cloud : clouds)
    all.insert(all.end(), cloud.points.begin(), cloud.points.end());
  Camera camera = fitCamera(chooseView(options, clouds), all, 2 * options.count("width"), 2 * options.count("height"));
  camera.pixels_per_unit *= options.number("zoom");
  if (options.given("center"))
    camera.centre = pointOfBox(clouds[0].box, vectorOption(options, "center"));
  return camera;
}

ColoringRequest
coloringFrom(const Options& options)
{
  ColoringRequest request;
  request.mode = options.text("color");
  request.plain = isSection(options) ? kDotInk : kClay;
  if (options.given("low"))
    request.low = options.number("low");
  if (options.given("high"))
    request.high = options.number("high");
  return request;
}

/** Spacing of a cloud for the discs. Noise makes the spacing of one cloud look larger than that of its filtered version; where both
 * show one surface, the number of points tells the truth. */
double
discSpacing(const PictureCloud& cloud, const std::vector<PictureCloud>& clouds)
{
  double spacing = cloud.spacing;
  for (const PictureCloud& other : clouds) {
    const double ratio = static_cast<double>(other.box.count) / static_cast<double>(cloud.box.count);
    spacing = std::min(spacing, other.spacing * std::sqrt(ratio));
  }
  return std::max(spacing, 0.7 * cloud.spacing);
}

/** Radius of the discs, or of the dots of a section, in cloud units. */
double
splatRadius(const Options& options, const PictureCloud& cloud, const std::vector<PictureCloud>& clouds, const Camera& camera)
{
  const Length wanted = options.length("splat");
  CloudScale scale;
  scale.spacing = cloud.spacing;
  scale.diagonal = cloud.box.diagonal();
  if (wanted.unit != Length::Unit::Auto)
    return wanted.resolve(scale);
  if (isSection(options))
    return std::max(0.12 * cloud.spacing, 2.8 / camera.pixels_per_unit);
  return 1.4 * discSpacing(cloud, clouds);
}

Image
drawPanel(const Options& options,
          const PictureCloud& cloud,
          const std::vector<PictureCloud>& clouds,
          std::vector<Color> colors,
          const Camera& camera)
{
  SplatCloud splats;
  splats.points = cloud.points;
  splats.normals = cloud.normals;
  splats.colors = std::move(colors);
  splats.radius = splatRadius(options, cloud, clouds, camera);
  splats.lit = options.text("color") != "rgb";
  const std::size_t threads = resolveThreads(threadCount(options));
  const VisibleSplats visible = cloud.triangles.empty() || isSection(options)
                                    ? drawSplats(splats, camera, threads)
                                    : drawTriangles(cloud.points, cloud.triangles, camera, threads);
  return halved(shadeSplats(splats, visible, camera, kPaper, threads));
}

std::vector<std::string>
labelsOf(const Options& options)
{
  const std::string& text = options.text("labels");
  const std::vector<std::string>& paths = options.files();
  std::vector<std::string> labels(paths.size());
  if (text == "none" || (text == "auto" && paths.size() == 1))
    return labels;
  if (text == "auto") {
    std::transform(paths.begin(), paths.end(), labels.begin(),
                   [](const std::string& path) { return path.substr(path.find_last_of('/') + 1); });
    return labels;
  }
  std::size_t begin = 0;
  for (std::size_t i = 0; i < labels.size() && begin <= text.size(); ++i) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    labels[i] = text.substr(begin, end - begin);
    begin = end + 1;
  }
  return labels;
}

void
writePicture(const Image& image, const Options& options)
{
  const std::vector<unsigned char> png = encodePng(image);
  const std::string& path = outputPath(options);
  if (path == "-")
    return printToStandardOutput(std::string(png.begin(), png.end()));
  AtomicFile file(path, options.given("overwrite"));
  file.write(png.data(), png.size());
  file.commit();
}

ExitCode
runRender(const Options& options)
{
  checkRenderOptions(options);
  checkWritable(outputPath(options), options.given("overwrite"));
  Console console(options);
  std::vector<PictureCloud> clouds;
  for (const std::string& path : options.files())
    clouds.push_back(readPictureCloud(path, threadCount(options), console));
  if (!isSection(options))
    setNormals(options, clouds);
  cut(options, clouds);
  Coloring coloring = colorClouds(clouds, coloringFrom(options));
  const Camera camera = chooseCamera(options, clouds);
  std::vector<Image> panels;
  for (std::size_t i = 0; i < clouds.size(); ++i)
    panels.push_back(drawPanel(options, clouds[i], clouds, std::move(coloring.colors[i]), camera));
  Image picture = composeSideBySide(panels, labelsOf(options));
  if (coloring.range)
    picture = withLegend(picture, options.text("color"), *coloring.range);
  writePicture(picture, options);
  console.say("wrote a picture of " + std::to_string(picture.width) + " x " + std::to_string(picture.height) + " pixels");
  return kExitOk;
}

} // namespace

Command
renderCommand()
{
  Command command;
  command.name = "render";
  command.summary = "Draws clouds and meshes side by side into a PNG picture, all in the same frame; needs no display";
  command.synopsis = "A [B ...] -o PICTURE.png [options]";
  command.examples = {{{"pcl_gpf_tool render scan.pcd clean.pcd -o picture.png", "before and after"},
                       {"pcl_gpf_tool render scan.pcd clean.pcd -o edge.png --section z --zoom 4 --center 0,0,0.5",
                        "a slice, close to a corner"},
                       {"pcl_gpf_tool render error.ply -o error.png --color distance --high 0.01", "a field as colours"}}};
  command.most_files = kMostClouds;
  command.options = renderOptions();
  command.run = runRender;
  return command;
}

} // namespace pcl_gpf
