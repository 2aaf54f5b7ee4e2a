// SPDX-License-Identifier: BSD-3-Clause
#include "experiment.h"

namespace pcl_gpf::quality {

Record
runMethod(const NoisyCloud& cloud, const Method& method, const MeasureOptions& options)
{
  Record best;
  for (const Variant& variant : method.variants) {
    const Figures figures = measure(cloud, variant.run(cloud, options.threads), options);
    if (best.method.empty() || figures.mean < best.figures.mean) {
      best.method = method.name;
      best.setting = variant.setting;
      best.figures = figures;
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
  std::vector<Method> methods;
  for (const std::string& name : options.methods)
    methods.push_back(makeMethod(name));
  std::vector<Record> records;
  for (const std::string& name : options.models)
    for (const std::size_t size : options.sizes) {
      const Model model = makeModel(name, size);
      for (const NoiseKind kind : options.kinds)
        for (const double outliers : options.outliers)
          for (const double percent : options.noises) {
            const NoisyCloud cloud = makeNoisyCloud(model, size, {kind, percent, outliers, options.seed});
            for (const Method& method : methods) {
              records.push_back(runMethod(cloud, method, measuring));
              report(records.back());
            }
          }
    }
  return records;
}

} // namespace pcl_gpf::quality
