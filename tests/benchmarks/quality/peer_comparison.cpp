// SPDX-License-Identifier: BSD-3-Clause
#include "peer_comparison.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl_gpf::quality {

namespace {

bool
isOurs(const Record& r)
{
  return r.method.rfind("ours", 0) == 0;
}

bool
isTunedPeer(const Record& r)
{
  const std::string ending = "-best";
  return r.method.size() > ending.size() &&
         r.method.compare(r.method.size() - ending.size(), ending.size(), ending) == 0;
}

bool
ofTheSameCloud(const Record& a, const Record& b)
{
  return a.model == b.model && a.size == b.size && a.noise.kind == b.noise.kind && a.noise.percent == b.noise.percent &&
         a.noise.outliers == b.noise.outliers && a.noise.seed == b.noise.seed;
}

std::string
meanAndEdges(const Figures& f)
{
  char text[40];
  if (std::isnan(f.edge_coverage))
    std::snprintf(text, sizeof text, "%8.2f %6s", f.mean, "-");
  else
    std::snprintf(text, sizeof text, "%8.2f %6.1f", f.mean, f.edge_coverage);
  return text;
}

} // namespace

std::vector<PeerComparison>
compareWithPeers(const std::vector<Record>& records)
{
  std::vector<PeerComparison> comparisons;
  for (const Record& ours : records) {
    const auto known = [&](const PeerComparison& c) { return ofTheSameCloud(*c.ours, ours); };
    if (!isOurs(ours) || std::any_of(comparisons.begin(), comparisons.end(), known)) continue;
    const Record* best = nullptr;
    for (const Record& r : records)
      if (isTunedPeer(r) && ofTheSameCloud(r, ours) && (best == nullptr || r.figures.mean < best->figures.mean))
        best = &r;
    if (best != nullptr) comparisons.push_back({&ours, best});
  }
  return comparisons;
}

std::string
peerTable(const std::vector<PeerComparison>& comparisons)
{
  char line[200];
  std::snprintf(line, sizeof line, "%-26s %5s %8s %6s %8s %6s  %-6s %s\n", "model", "%", "ours", "ecov", "peer", "ecov",
                "ratio", "verdict");
  std::string table = line;
  std::size_t worse = 0;
  for (const PeerComparison& c : comparisons) {
    worse += !c.holds();
    std::snprintf(line, sizeof line, "%-26s %5g %s %s  %-6.3f %s %s, %s\n", c.ours->model.c_str(),
                  c.ours->noise.percent, meanAndEdges(c.ours->figures).c_str(), meanAndEdges(c.peer->figures).c_str(),
                  c.ours->figures.mean / c.peer->figures.mean, c.holds() ? "holds against" : "WORSE than",
                  c.peer->method.c_str(), c.peer->setting.c_str());
    table += line;
  }
  std::snprintf(line, sizeof line, "%zu of %zu clouds are worse than with the best tuned peer\n", worse,
                comparisons.size());
  return table + line;
}

} // namespace pcl_gpf::quality
