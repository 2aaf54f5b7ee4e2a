// SPDX-License-Identifier: BSD-3-Clause
#include "options.h"
#include "mesh_surface.h"
#include "methods.h"
#include "numbers.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

namespace pcl_gpf::quality {

namespace {

std::vector<std::string>
split(const std::string& text)
{
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/** Replaces the names of groups by their members. */
std::vector<std::string>
expandModels(const std::string& text)
{
  std::vector<std::string> models;
  for (const std::string& name : split(text))
    if (name == "analytic")
      models.insert(models.end(), {"cube", "block", "sphere", "relief", "cylinder", "torus", "sheets", "plane", "cap",
                                   "cube-graded", "block-graded"});
    else if (name == "meshes")
      for (const std::string& mesh : sharedMeshNames())
        models.push_back("mesh:" + mesh);
    else
      models.push_back(name);
  return models;
}

std::uint64_t
wholeNumber(const std::string& text)
{
  constexpr double kLargestExact = 9007199254740992.0;
  const double value = toNumber(text);
  if (!(value >= 0 && value <= kLargestExact) || value != std::floor(value))
    throw std::invalid_argument("\"" + text + "\" is not a whole number");
  return static_cast<std::uint64_t>(value);
}

std::vector<double>
numbersWithin(const std::string& text, double most)
{
  std::vector<double> values;
  for (const std::string& part : split(text)) {
    values.push_back(toNumber(part));
    if (!(values.back() >= 0 && values.back() <= most))
      throw std::invalid_argument("\"" + part + "\" is not within 0 .. " + std::to_string(most));
  }
  return values;
}

} // namespace

Options
parseOptions(const std::vector<std::string>& arguments)
{
  Options o;
  const std::map<std::string, std::function<void()>> flags = {{"--targets", [&] { o.targets = true; }},
                                                              {"--against-peers", [&] { o.against_peers = true; }},
                                                              {"--noise-estimates", [&] { o.noise_estimates = true; }},
                                                              {"--help", [&] { o.help = true; }}};
  const std::map<std::string, std::function<void(const std::string&)>> values = {
      {"--models", [&](const std::string& v) { o.models = expandModels(v); }},
      {"--noises", [&](const std::string& v) { o.noises = numbersWithin(v, 100); }},
      {"--kinds",
       [&](const std::string& v) {
         o.kinds.clear();
         for (const std::string& name : split(v))
           o.kinds.push_back(noiseKind(name));
       }},
      {"--sizes",
       [&](const std::string& v) {
         o.sizes.clear();
         for (const std::string& size : split(v))
           o.sizes.push_back(std::max<std::size_t>(1, wholeNumber(size)));
       }},
      {"--outliers",
       [&](const std::string& v) {
         o.outliers = numbersWithin(v, 100);
         for (double& share : o.outliers)
           share /= 100;
       }},
      {"--methods", [&](const std::string& v) { o.methods = split(v); }},
      {"--seed", [&](const std::string& v) { o.seed = wholeNumber(v); }},
      {"--threads", [&](const std::string& v) { o.threads = static_cast<unsigned>(wholeNumber(v)); }},
      {"--references", [&](const std::string& v) { o.references = std::max<std::size_t>(1, wholeNumber(v)); }},
      {"--csv", [&](const std::string& v) { o.csv = v; }},
      {"--reuse", [&](const std::string& v) { o.reuse = v; }},
      {"--svg-dir", [&](const std::string& v) { o.svg_dir = v; }},
      {"--cloud-dir", [&](const std::string& v) { o.cloud_dir = v; }},
  };
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (const auto flag = flags.find(arguments[i]); flag != flags.end())
      flag->second();
    else if (const auto value = values.find(arguments[i]); value != values.end() && i + 1 < arguments.size())
      value->second(arguments[++i]);
    else
      throw std::invalid_argument(arguments[i] + " is unknown or lacks its value");
  }
  for (const std::string& method : o.methods)
    if (o.reuse.empty())  // a build without the peers can draw what one with them measured
      makeMethod(method); // refuses unknown names before anything runs
  return o;
}

std::string
usage()
{
  return std::string("usage: quality [--models NAME,...] [--noises PERCENT,...] [--kinds KIND,...] [--sizes N,...] "
                     "[--outliers PERCENT,...]\n"
                     "               [--methods NAME,...] [--seed N] [--threads N] [--references N] [--csv FILE] "
                     "[--svg-dir DIR]\n"
                     "               [--cloud-dir DIR: filtered clouds as PLY, with their distances to the surface]\n"
                     "               [--reuse FILE: other filters are not run; their records come from this CSV file, "
                     "where it has them]\n"
                     "               [--against-peers: ends with a verdict for each cloud, the first method \"ours...\" against "
                     "the best that ends in -best]\n"
                     "       quality --targets [--seed N] [--threads N] [--csv FILE]\n"
                     "       quality --noise-estimates [--models ...] [--noises ...] [--kinds ...] [--sizes ...] "
                     "[--outliers ...] [--seed N]: estimate / truth\n"
                     "Makes clouds from models, filters them and prints the errors, in 1e-4 of the box diagonal.\n"
                     "models: ") +
         kModelNames + ";\n        groups: analytic, meshes\n" +
         "kinds of noise: gaussian, normal, uniform (even within +-p %), scanner\nmethods:\n" + describeMethods();
}

} // namespace pcl_gpf::quality
