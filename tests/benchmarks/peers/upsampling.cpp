// SPDX-License-Identifier: BSD-3-Clause
#include "peer_upsampling.h"

#include "benchmarks/benchmark_statistics.h"
#include "benchmarks/model_cloud.h"
#include "benchmarks/option_values.h"
#include "benchmarks/stopwatch.h"

#include <pcl_gpf/pipeline/upsample.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

/** \file
 * \brief Edge-aware upsampling beside CGAL's: the same filtered unit cube with the same oriented normals, in turn, one thread each.
 *
 * Lengths are in 1/10000 of the box diagonal. error: mean distance of all points to the cube's surface. edges: mean distance from
 * places on its edges to the nearest point. holes: 95th percentile of the distance from places on its faces to the nearest point.
 * uneven: deviation of the distances of all points to their nearest neighbours, as a share of their mean.
 */
namespace {

using namespace pcl_gpf;
using namespace pcl_gpf::benchmark_peers;
using benchmark_statistics::median;

constexpr const char* kUsage = "usage: upsampling [--size N] [--noise PERCENT] [--factors 2,8] [--exponents 0,5,10] [--repeat N]\n"
                               "                  [--most-seconds S: no more runs of a method after one that took longer]\n"
                               "                  [--peer 1: 0 = without CGAL]\n";

struct Choice {
  std::size_t size = 33490;
  double noise = 1.0;
  std::vector<double> factors{2, 8}, exponents{0, 5, 10};
  unsigned repeat = 3;
  double most_seconds = 60;
  bool peer = true;
};

Choice
parse(int argc, char** argv)
{
  using namespace benchmark_options;
  Choice choice;
  const auto numbers = [](const char* text) {
    std::vector<double> values;
    for (const std::string& part : list(text))
      values.push_back(number<double>(part));
    return values;
  };
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    if (i + 1 == argc)
      throw std::invalid_argument(name + " has no value");
    if (name == "--size")
      choice.size = number<std::size_t>(argv[i + 1]);
    else if (name == "--noise")
      choice.noise = number<double>(argv[i + 1]);
    else if (name == "--factors")
      choice.factors = numbers(argv[i + 1]);
    else if (name == "--exponents")
      choice.exponents = numbers(argv[i + 1]);
    else if (name == "--repeat")
      choice.repeat = number<unsigned>(argv[i + 1]);
    else if (name == "--most-seconds")
      choice.most_seconds = number<double>(argv[i + 1]);
    else if (name == "--peer")
      choice.peer = number<unsigned>(argv[i + 1]) != 0;
    else
      throw std::invalid_argument("unknown option " + name);
  }
  return choice;
}

/** The cube's outward normal of the face that is nearest in direction. */
bool
facesOutward(double x, double y, double z, double nx, double ny, double nz)
{
  return nx * (x - 0.5) + ny * (y - 0.5) + nz * (z - 0.5) >= 0.0;
}

PeerCloud
filteredCube(const Choice& choice)
{
  const benchmark_models::ModelCloud noisy("cube", choice.size, choice.noise);
  const DenoiseResult clean = denoise(noisy.input(choice.size), {});
  PeerCloud cloud;
  cloud.x = clean.x;
  cloud.y = clean.y;
  cloud.z = clean.z;
  for (std::size_t i = 0; i < clean.x.size(); ++i) {
    const double nx = static_cast<double>(clean.normal_x[i]), ny = static_cast<double>(clean.normal_y[i]),
                 nz = static_cast<double>(clean.normal_z[i]);
    const double sign = facesOutward(clean.x[i], clean.y[i], clean.z[i], nx, ny, nz) ? 1.0 : -1.0;
    cloud.normal_x.push_back(sign * nx);
    cloud.normal_y.push_back(sign * ny);
    cloud.normal_z.push_back(sign * nz);
  }
  return cloud;
}

PeerCloud
ours(const PeerCloud& cloud, double factor, double exponent)
{
  std::vector<float> n[3];
  n[0].assign(cloud.normal_x.begin(), cloud.normal_x.end());
  n[1].assign(cloud.normal_y.begin(), cloud.normal_y.end());
  n[2].assign(cloud.normal_z.begin(), cloud.normal_z.end());
  DenoiseInput input;
  input.x = cloud.x.data();
  input.y = cloud.y.data();
  input.z = cloud.z.data();
  input.size = cloud.size();
  input.normal_x = n[0].data();
  input.normal_y = n[1].data();
  input.normal_z = n[2].data();
  UpsampleParameters p;
  p.edge_aware.factor = factor;
  p.edge_aware.edge_sensitivity = exponent;
  p.edge_aware.number_of_threads = 1;
  UpsampleResult made = upsample(input, p);
  PeerCloud result;
  result.x = std::move(made.x);
  result.y = std::move(made.y);
  result.z = std::move(made.z);
  return result;
}

struct Quality {
  double error = 0, edges = 0, holes = 0, uneven = 0;
};

double
distanceToCube(double x, double y, double z)
{
  double outside = 0.0, depth = 1.0;
  for (const double c : {x, y, z}) {
    const double beyond = std::max({-c, c - 1.0, 0.0});
    outside += beyond * beyond;
    depth = std::min({depth, std::abs(c), std::abs(1.0 - c)});
  }
  return outside > 0.0 ? std::sqrt(outside) : depth;
}

Quality
judge(const PeerCloud& input, const PeerCloud& made)
{
  const std::size_t count = input.size() + made.size();
  SoaBuffer points(count);
  Quality quality;
  for (std::size_t i = 0; i < count; ++i) {
    const PeerCloud& from = i < input.size() ? input : made;
    const std::size_t k = i < input.size() ? i : i - input.size();
    quality.error += distanceToCube(from.x[k], from.y[k], from.z[k]) / static_cast<double>(count);
    points.x[i] = static_cast<float>(from.x[k]);
    points.y[i] = static_cast<float>(from.y[k]);
    points.z[i] = static_cast<float>(from.z[k]);
  }
  const PointIndex index(static_cast<const SoaBuffer&>(points).view());
  std::vector<float> nearest_sq;
  const auto nearest = [&](const std::array<float, 3>& place, std::size_t k) {
    index.tree().nearest(index.sorted(), place, k, nearest_sq);
    return std::sqrt(static_cast<double>(nearest_sq.back()));
  };
  constexpr int kPlaces = 500;
  for (int edge = 0; edge < 12; ++edge)
    for (int k = 0; k < kPlaces; ++k) {
      const float along = (static_cast<float>(k) + 0.5f) / kPlaces, a = edge & 1 ? 1.0f : 0.0f, b = edge & 2 ? 1.0f : 0.0f;
      quality.edges += nearest(edge < 4 ? std::array<float, 3>{along, a, b}
                               : edge < 8 ? std::array<float, 3>{a, along, b} : std::array<float, 3>{a, b, along}, 1) / (12 * kPlaces);
    }
  constexpr int kRows = 150;
  std::vector<double> holes;
  for (int face = 0; face < 6; ++face)
    for (int k = 0; k < kRows * kRows; ++k) {
      const float u = (static_cast<float>(k % kRows) + 0.5f) / kRows, v = (static_cast<float>(k / kRows) + 0.5f) / kRows;
      const float w = face & 1 ? 1.0f : 0.0f;
      holes.push_back(nearest(face < 2 ? std::array<float, 3>{u, v, w}
                              : face < 4 ? std::array<float, 3>{u, w, v} : std::array<float, 3>{w, u, v}, 1));
    }
  std::sort(holes.begin(), holes.end());
  double sum = 0.0, sum_sq = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double d = nearest({points.x[i], points.y[i], points.z[i]}, 2);
    sum += d;
    sum_sq += d * d;
  }
  const double unit = 1e4 / std::sqrt(3.0), mean = sum / static_cast<double>(count);
  return {quality.error * unit, quality.edges * unit, holes[holes.size() * 95 / 100] * unit,
          std::sqrt(std::max(0.0, sum_sq / static_cast<double>(count) - mean * mean)) / mean};
}

void
printRow(double factor, double exponent, const char* method, std::size_t inserted, std::size_t count, double seconds, const Quality& q)
{
  std::printf("x%-4g %-4g %-6s %9zu %9.3f %9.2f %9.2f %9.2f %9.2f %9.3f\n", factor, exponent, method, count, seconds,
              seconds / static_cast<double>(std::max<std::size_t>(1, inserted)) * 1e6, q.error, q.edges, q.holes, q.uneven);
}

void
compare(const Choice& choice, const PeerCloud& cloud, double factor, double exponent)
{
  const auto target = static_cast<std::size_t>(factor * static_cast<double>(cloud.size()));
  std::vector<double> seconds[2];
  PeerCloud made[2];
  for (unsigned round = 0; round < choice.repeat; ++round)
    for (int method = 0; method < (choice.peer ? 2 : 1); ++method) {
      if (!seconds[method].empty() && seconds[method].back() > choice.most_seconds)
        continue;
      const benchmark_timing::Stopwatch watch;
      made[method] = method == 0 ? ours(cloud, factor, exponent) : cgalUpsample(cloud, exponent / 10.0, target);
      seconds[method].push_back(watch.elapsed().processor);
    }
  for (int method = 0; method < (choice.peer ? 2 : 1); ++method)
    printRow(factor, exponent, method == 0 ? "ours" : "CGAL", made[method].size(), cloud.size() + made[method].size(),
             median(seconds[method]), judge(cloud, made[method]));
  if (choice.peer)
    std::printf("           CGAL / ours: %.1f\n", median(seconds[1]) / median(seconds[0]));
  std::fflush(stdout);
}

} // namespace

int
main(int argc, char** argv)
{
  try {
    const Choice choice = parse(argc, argv);
    const PeerCloud cloud = filteredCube(choice);
    std::printf("cube, %g %% noise, filtered\n", choice.noise);
    std::printf("%-5s %-4s %-6s %9s %9s %9s %9s %9s %9s %9s\n", "", "rho", "", "points", "CPU s", "us/new", "error", "edges", "holes",
                "uneven");
    printRow(1, 0, "before", 0, cloud.size(), 0.0, judge(cloud, PeerCloud()));
    for (const double factor : choice.factors)
      for (const double exponent : choice.exponents)
        compare(choice, cloud, factor, exponent);
    return 0;
  } catch (const std::invalid_argument& e) {
    std::fprintf(stderr, "upsampling: %s\n%s", e.what(), kUsage);
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "upsampling: %s\n", e.what());
    return 1;
  }
}
