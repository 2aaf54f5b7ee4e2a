// SPDX-License-Identifier: BSD-3-Clause
#include "experiment.h"
#include "report.h"
#include "result_cloud.h"

#include <algorithm>
#include <filesystem>

namespace pcl_gpf::quality {

namespace {

bool
isOtherFilter(const std::string& method)
{
  const std::string base = method.substr(0, method.find(':'));
  return base != "ours" && base != "paper" && base != "input" && base != "clean";
}

const Record*
findEarlier(const std::vector<Record>& earlier, const NoisyCloud& cloud, const std::string& method)
{
  const auto found = std::find_if(earlier.begin(), earlier.end(), [&](const Record& r) {
    return r.model == cloud.model.name && r.size == cloud.points.size() && r.noise.kind == cloud.spec.kind &&
           r.noise.percent == cloud.spec.percent && r.noise.outliers == cloud.spec.outliers &&
           r.noise.seed == cloud.spec.seed && r.method == method;
  });
  return found == earlier.end() ? nullptr : &*found;
}

} // namespace

Record
runMethod(const NoisyCloud& cloud, const Method& method, const MeasureOptions& options, MethodResult* best_result)
{
  Record best;
  for (const Variant& variant : method.variants) {
    MethodResult result = variant.run(cloud, options.threads);
    const Figures figures = measure(cloud, result, options);
    if (best.method.empty() || figures.mean < best.figures.mean) {
      best.method = method.name;
      best.setting = variant.setting;
      best.figures = figures;
      if (best_result != nullptr)
        *best_result = std::move(result);
    }
  }
  best.model = cloud.model.name;
  best.size = cloud.points.size();
  best.noise = cloud.spec;
  return best;
}

std::vector<Record>
runExperiment(const Options& options, const std::function<void(const Record&)>& report)
{
  MeasureOptions measuring;
  measuring.references = options.references;
  measuring.threads = options.threads;
  std::vector<Record> records, earlier;
  if (!options.cloud_dir.empty())
    std::filesystem::create_directories(options.cloud_dir);
  if (!options.reuse.empty())
    earlier = readCsv(options.reuse);
  for (const std::string& name : options.models)
    for (const std::size_t size : options.sizes) {
      const Model model = makeModel(name, size);
      for (const NoiseKind kind : options.kinds)
        for (const double outliers : options.outliers)
          for (const double percent : options.noises) {
            const NoisyCloud cloud = makeNoisyCloud(model, size, {kind, percent, outliers, options.seed});
            for (const std::string& method : options.methods) {
              const bool take = !options.reuse.empty() && isOtherFilter(method); // it does not change with this project
              const Record* const known = take ? findEarlier(earlier, cloud, method) : nullptr;
              if (take && known == nullptr)
                continue;
              MethodResult made;
              records.push_back(take ? *known : runMethod(cloud, makeMethod(method), measuring, &made));
              if (!options.cloud_dir.empty() && !take)
                writeResultCloud(options.cloud_dir + "/" + cloudFileName(records.back()), cloud, made);
              report(records.back());
            }
          }
    }
  return records;
}

} // namespace pcl_gpf::quality
