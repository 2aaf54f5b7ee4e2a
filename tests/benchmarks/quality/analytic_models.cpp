// SPDX-License-Identifier: BSD-3-Clause
#include "analytic_models.h"
#include "analytic_surface.h"

#include <algorithm>

namespace pcl_gpf::quality {

namespace {

using Parts = AnalyticSurface::Parts;
using Circle = RectanglePatch::Circle;
using Hole = RectanglePatch::Hole;

template <typename P, typename... Arguments>
void
add(Parts& parts, Arguments&&... arguments)
{
  parts.patches.push_back(std::make_unique<P>(std::forward<Arguments>(arguments)...));
}

void
addRectangle(Parts& parts, std::size_t axis, double level, Planar low, Planar high, double sign,
             std::vector<Circle> circles = {}, std::vector<Hole> holes = {})
{
  add<RectanglePatch>(parts, axis, level, low, high, sign, std::move(circles), std::move(holes));
}

void
addBoxEdges(Parts& parts, const Position& low, const Position& high)
{
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t u = a == 0 ? 1 : 0, v = a == 2 ? 1 : 2;
    for (int corner = 0; corner < 4; ++corner) {
      Position from = low, to = high;
      from[u] = to[u] = corner < 2 ? low[u] : high[u];
      from[v] = to[v] = corner % 2 == 0 ? low[v] : high[v];
      parts.edges.push_back(Curve::segment(from, to));
    }
  }
}

void
addSquareBoundary(Parts& parts, double z)
{
  parts.boundary.push_back(Curve::segment({0, 0, z}, {1, 0, z}, {0, -1, 0}));
  parts.boundary.push_back(Curve::segment({0, 1, z}, {1, 1, z}, {0, 1, 0}));
  parts.boundary.push_back(Curve::segment({0, 0, z}, {0, 1, z}, {-1, 0, 0}));
  parts.boundary.push_back(Curve::segment({1, 0, z}, {1, 1, z}, {1, 0, 0}));
}

Parts
cube()
{
  Parts parts;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double side : {0.0, 1.0})
      addRectangle(parts, axis, side, {0, 0}, {1, 1}, 2 * side - 1);
  addBoxEdges(parts, {0, 0, 0}, {1, 1, 1});
  parts.box_max = {1, 1, 1};
  parts.inside = [](const Position& p) {
    return std::all_of(p.begin(), p.end(), [](double c) { return c > 0 && c < 1; });
  };
  return parts;
}

/** An L-shaped bracket: a plate with a cylindrical through hole, and an upright. */
Parts
block()
{
  constexpr double kLength = 2, kWidth = 1, kHeight = 1.4, kPlate = 0.6, kUpright = 0.6;
  constexpr Planar kCentre = {1.35, 0.5};
  constexpr double kRadius = 0.28;
  Parts parts;
  addRectangle(parts, 2, 0, {0, 0}, {kLength, kWidth}, -1, {{kCentre, kRadius}});
  addRectangle(parts, 2, kPlate, {kUpright, 0}, {kLength, kWidth}, 1, {{kCentre, kRadius}});
  addRectangle(parts, 0, kLength, {0, 0}, {kWidth, kPlate}, 1);
  addRectangle(parts, 0, 0, {0, 0}, {kWidth, kHeight}, -1);
  addRectangle(parts, 0, kUpright, {0, kPlate}, {kWidth, kHeight}, 1);
  addRectangle(parts, 2, kHeight, {0, 0}, {kUpright, kWidth}, 1);
  for (const double side : {0.0, 1.0}) {
    addRectangle(parts, 1, side * kWidth, {0, 0}, {kLength, kPlate}, 2 * side - 1);
    addRectangle(parts, 1, side * kWidth, {0, kPlate}, {kUpright, kHeight}, 2 * side - 1);
  }
  add<CylinderPatch>(parts, kCentre, kRadius, 0.0, kPlate, -1.0);

  const Planar profile[] = {{0, 0},      {kLength, 0}, {kLength, kPlate}, {kUpright, kPlate}, {kUpright, kHeight},
                            {0, kHeight}};
  for (std::size_t i = 0; i < 6; ++i) {
    const Planar a = profile[i], b = profile[(i + 1) % 6];
    parts.edges.push_back(Curve::segment({a[0], 0, a[1]}, {b[0], 0, b[1]}));
    parts.edges.push_back(Curve::segment({a[0], kWidth, a[1]}, {b[0], kWidth, b[1]}));
    parts.edges.push_back(Curve::segment({a[0], 0, a[1]}, {a[0], kWidth, a[1]}));
  }
  for (const double z : {0.0, kPlate})
    parts.edges.push_back(Curve::circle({kCentre[0], kCentre[1], z}, kRadius));
  parts.box_max = {kLength, kWidth, kHeight};
  parts.inside = [kCentre](const Position& p) {
    const bool in_box = p[0] > 0 && p[0] < kLength && p[1] > 0 && p[1] < kWidth && p[2] > 0 && p[2] < kHeight;
    const bool in_hole = std::hypot(p[0] - kCentre[0], p[1] - kCentre[1]) < kRadius;
    return in_box && (p[2] < kPlate ? !in_hole : p[0] < kUpright);
  };
  return parts;
}

Parts
sphere()
{
  Parts parts;
  add<CapPatch>(parts, Position{0, 0, 0}, 1.0, 2.0);
  parts.box_min = {-1, -1, -1};
  parts.box_max = {1, 1, 1};
  parts.inside = [](const Position& p) { return length(p) < 1; };
  return parts;
}

struct Boss {
  double x, y, width, depth, height;
};
struct Dome {
  double x, y, rim, height;
  double
  radius() const
  {
    return (rim * rim + height * height) / (2 * height);
  }
};

constexpr Boss kBosses[] = {{.08, .08, .02, .30, .03}, {.15, .08, .04, .30, .03}, {.24, .08, .07, .30, .04},
                            {.36, .08, .14, .30, .04}, {.08, .48, .42, .02, .03}, {.08, .55, .42, .05, .015},
                            {.08, .66, .42, .10, .04}, {.08, .82, .42, .10, .02}};
constexpr Dome kDomes[] = {{.68, .20, .10, .03}, {.86, .36, .06, .03}, {.66, .56, .08, .06}, {.80, .80, .14, .04}};

double
reliefHeight(double x, double y)
{
  for (const Boss& b : kBosses)
    if (x > b.x && x < b.x + b.width && y > b.y && y < b.y + b.depth)
      return b.height;
  for (const Dome& d : kDomes) {
    const double from_centre = std::hypot(x - d.x, y - d.y);
    if (from_centre < d.rim)
      return std::sqrt(d.radius() * d.radius() - from_centre * from_centre) + d.height - d.radius();
  }
  return 0;
}

/** A unit square with rectangular bosses and spherical domes, all of them small. */
Parts
relief()
{
  Parts parts;
  std::vector<Hole> holes;
  std::vector<Circle> circles;
  for (const Boss& b : kBosses) {
    const double x1 = b.x + b.width, y1 = b.y + b.depth;
    holes.push_back({{b.x, b.y}, {x1, y1}});
    addRectangle(parts, 2, b.height, {b.x, b.y}, {x1, y1}, 1);
    addRectangle(parts, 0, b.x, {b.y, 0}, {y1, b.height}, -1);
    addRectangle(parts, 0, x1, {b.y, 0}, {y1, b.height}, 1);
    addRectangle(parts, 1, b.y, {b.x, 0}, {x1, b.height}, -1);
    addRectangle(parts, 1, y1, {b.x, 0}, {x1, b.height}, 1);
    addBoxEdges(parts, {b.x, b.y, 0}, {x1, y1, b.height});
  }
  for (const Dome& d : kDomes) {
    circles.push_back({{d.x, d.y}, d.rim});
    add<CapPatch>(parts, Position{d.x, d.y, d.height - d.radius()}, d.radius(), d.height);
    parts.edges.push_back(Curve::circle({d.x, d.y, 0}, d.rim));
  }
  addRectangle(parts, 2, 0, {0, 0}, {1, 1}, 1, circles, holes);
  addSquareBoundary(parts, 0);
  parts.box_max = {1, 1, .06};
  parts.inside = [](const Position& p) { return p[2] < reliefHeight(p[0], p[1]); };
  return parts;
}

/** Closed, with two circular edges. */
Parts
cylinder()
{
  constexpr double kRadius = 0.5, kHeight = 1.5;
  Parts parts;
  add<CylinderPatch>(parts, Planar{0, 0}, kRadius, 0.0, kHeight, 1.0);
  for (const double z : {0.0, kHeight}) {
    add<DiskPatch>(parts, Planar{0, 0}, z, kRadius, z > 0 ? 1.0 : -1.0);
    parts.edges.push_back(Curve::circle({0, 0, z}, kRadius));
  }
  parts.box_min = {-kRadius, -kRadius, 0};
  parts.box_max = {kRadius, kRadius, kHeight};
  parts.inside = [](const Position& p) { return std::hypot(p[0], p[1]) < kRadius && p[2] > 0 && p[2] < kHeight; };
  return parts;
}

Parts
torus()
{
  constexpr double kRing = 1, kTube = 0.35;
  Parts parts;
  add<TorusPatch>(parts, kRing, kTube);
  parts.box_min = {-kRing - kTube, -kRing - kTube, -kTube};
  parts.box_max = {kRing + kTube, kRing + kTube, kTube};
  parts.inside = [](const Position& p) { return std::hypot(std::hypot(p[0], p[1]) - kRing, p[2]) < kTube; };
  return parts;
}

/** A flat open patch. */
Parts
plane()
{
  Parts parts;
  addRectangle(parts, 2, 0, {0, 0}, {1, 1}, 1);
  addSquareBoundary(parts, 0);
  parts.box_max = {1, 1, 0};
  parts.inside = [](const Position& p) { return p[2] < 0; };
  return parts;
}

/** A curved open patch: the part of the unit sphere within 60 degrees of its pole. */
Parts
cap()
{
  constexpr double kUp = 0.5;
  const double rim = std::sqrt(1 - kUp * kUp);
  Parts parts;
  add<CapPatch>(parts, Position{0, 0, 0}, 1.0, 1 - kUp);
  parts.boundary.push_back(Curve::circle({0, 0, kUp}, rim, kUp, -rim));
  parts.box_min = {-rim, -rim, kUp};
  parts.box_max = {rim, rim, 1};
  parts.inside = [](const Position& p) { return length(p) < 1; };
  return parts;
}

} // namespace

std::shared_ptr<const Surface>
analyticSurface(const std::string& name)
{
  struct Entry {
    const char* name;
    Parts (*parts)();
  };
  constexpr Entry kModels[] = {{"cube", cube},         {"block", block}, {"sphere", sphere}, {"relief", relief},
                               {"cylinder", cylinder}, {"torus", torus}, {"plane", plane},   {"cap", cap}};
  for (const Entry& entry : kModels)
    if (name == entry.name)
      return std::make_shared<AnalyticSurface>(entry.parts());
  return nullptr;
}

std::shared_ptr<const Surface>
sheetsSurface(double gap)
{
  Parts parts;
  for (const double side : {-1.0, 1.0}) {
    addRectangle(parts, 2, 0.5 * side * gap, {0, 0}, {1, 1}, side);
    addSquareBoundary(parts, 0.5 * side * gap);
  }
  parts.box_min = {0, 0, -0.5 * gap};
  parts.box_max = {1, 1, 0.5 * gap};
  parts.inside = [gap](const Position& p) { return std::abs(p[2]) < 0.5 * gap; };
  return std::make_shared<AnalyticSurface>(std::move(parts));
}

} // namespace pcl_gpf::quality
