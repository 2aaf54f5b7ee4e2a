// SPDX-License-Identifier: BSD-3-Clause
#include "targets.h"
#include "report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl_gpf::quality {

namespace {

constexpr std::size_t kSize = 33490;
constexpr double kNone = Figures::kNone;

double
mean(const Figures& f)
{
  return f.mean;
}
double
edgeCoverage(const Figures& f)
{
  return f.edge_coverage;
}
double
bias(const Figures& f)
{
  return std::abs(f.signed_mean);
}

/** The worse of both views on a boundary: its outermost points, and the movement of all points near it. */
double
recession(const Figures& f)
{
  return std::max(f.recession, f.boundary_pull);
}

struct ErrorTargets {
  const char* model;
  double percent, mean_must, mean_aim, edge_must, edge_aim;
};

constexpr ErrorTargets kErrors[] = {
    {"block", 0.25, 4.6, 3.5, 38, 34},     {"block", 0.5, 7.5, 5.5, 42, 37},
    {"block", 1, 12.5, 9.5, 49, 41},       {"block", 1.5, 20, 15, 58, 48},
    {"block", 3, 50, 35, 75, 57},          {"cube", 0.5, 7.2, 5.5, 47, 42},
    {"cube", 1, 10.5, 8.5, 52, 45},        {"sphere", 0.5, 4.8, 3.3, kNone, kNone},
    {"sphere", 1, 6.5, 4.5, kNone, kNone}, {"relief", 0.5, 11.5, 9, 45, 36},
    {"relief", 1, 20, 15, 58, 50},
};

} // namespace

std::vector<Target>
allTargets()
{
  std::vector<Target> targets;
  for (const ErrorTargets& e : kErrors) {
    targets.push_back({e.model, e.percent, "mean", mean, e.mean_must, e.mean_aim});
    if (e.edge_must > 0)
      targets.push_back({e.model, e.percent, "ecov", edgeCoverage, e.edge_must, e.edge_aim});
    else
      targets.push_back({e.model, e.percent, "|signed|", bias, 2, kNone});
  }
  for (const char* model : {"cube", "block", "sphere", "relief", "cylinder", "torus", "sheets", "plane", "cap",
                            "cube-graded", "block-graded"})
    targets.push_back({model, 0, "move_away", [](const Figures& f) { return f.movement_away; }, 1e-3, kNone});
  targets.push_back({"sheets", 0.25, "wrong", [](const Figures& f) { return f.wrong_sheet; }, 0.01, kNone});
  targets.push_back({"sheets", 0.25, "middle", [](const Figures& f) { return f.middle_of_gap; }, 0.01, kNone});
  for (const char* model : {"plane", "cap"})
    targets.push_back({model, 0.5, "recession", recession, 1, kNone});
  return targets;
}

std::vector<TargetResult>
runTargets(const Options& options, const std::function<void(const Record&)>& report)
{
  const auto chosen =
      std::find_if(options.methods.begin(), options.methods.end(), [](const auto& m) { return m != "input"; });
  const Method method = makeMethod(chosen == options.methods.end() ? "ours" : *chosen);
  MeasureOptions measuring;
  measuring.references = options.references;
  measuring.threads = options.threads;
  std::vector<TargetResult> results;
  Record record;
  for (const Target& target : allTargets()) {
    if (record.model != target.model || record.noise.percent != target.percent) {
      record = runMethod(
          makeNoisyCloud(makeModel(target.model, kSize), kSize, {NoiseKind::Gaussian, target.percent, 0, options.seed}),
          method, measuring);
      report(record);
    }
    results.push_back({target, target.value(record.figures)});
  }
  return results;
}

std::string
targetTable(const std::vector<TargetResult>& results)
{
  char line[120];
  std::snprintf(line, sizeof line, "%-14s %5s %-10s %9s %9s %9s  %s\n", "model", "%", "figure", "reached", "must",
                "aim", "verdict");
  std::string table = line;
  std::size_t failed = 0;
  for (const TargetResult& r : results) {
    const Target& t = r.target;
    const char* verdict = !r.holds() ? "FAILS" : r.value <= t.aim ? "aim" : "must";
    failed += !r.holds();
    const int length = std::snprintf(line, sizeof line, "%-14s %5g %-10s %9.4g %9.4g ", t.model.c_str(), t.percent,
                                     t.name, r.value, t.must);
    table.append(line, static_cast<std::size_t>(length));
    if (std::isnan(t.aim))
      std::snprintf(line, sizeof line, "%9s  %s\n", "-", verdict);
    else
      std::snprintf(line, sizeof line, "%9.4g  %s\n", t.aim, verdict);
    table += line;
  }
  std::snprintf(line, sizeof line, "%zu of %zu figures fall short of what they must reach\n", failed, results.size());
  return table + line;
}

} // namespace pcl_gpf::quality
