// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/simd.h>

#include "kernels/kernels.h"

#include <atomic>
#include <cstdlib>

#include <hwy/targets.h>

namespace pcl_gpf {

namespace {

std::vector<const kernels::KernelTarget*>
usableTargets()
{
  std::size_t count = 0;
  const kernels::KernelTarget* built = kernels::builtTargets(&count);
  std::vector<const kernels::KernelTarget*> usable;
  for (std::size_t i = 0; i < count; ++i)
    if ((hwy::SupportedTargets() & built[i].bit) != 0 || i + 1 == count) // the last needs nothing beyond the baseline
      usable.push_back(&built[i]);
  return usable;
}

const kernels::KernelTarget*
findTarget(const std::string& name)
{
  const auto usable = usableTargets();
  if (name.empty())
    return usable.front();
  std::string known;
  for (const auto* target : usable) {
    if (name == target->name)
      return target;
    known += (known.empty() ? "" : ", ") + std::string(target->name);
  }
  throw InvalidParameter("instruction set \"" + name + "\" is not available here; there are: " + known);
}

std::atomic<const kernels::KernelTarget*>&
activeTarget()
{
  static std::atomic<const kernels::KernelTarget*> target{[] {
    const char* forced = std::getenv("PCL_GPF_SIMD");
    return findTarget(forced ? forced : "");
  }()};
  return target;
}

} // namespace

std::vector<std::string>
availableSimdTargets()
{
  std::vector<std::string> names;
  for (const auto* target : usableTargets())
    names.emplace_back(target->name);
  return names;
}

std::string
activeSimdTarget()
{
  return activeTarget().load()->name;
}

void
setSimdTarget(const std::string& name)
{
  activeTarget().store(findTarget(name));
}

const kernels::KernelSet&
kernels::active()
{
  return *activeTarget().load()->set;
}

} // namespace pcl_gpf
