// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <array>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace pcl_gpf {

namespace {

constexpr unsigned kMostThreads = 1024;

} // namespace

std::size_t
resolveThreads(unsigned requested)
{
  // oneTBB counts the processors of the affinity mask.
  if (requested == 0)
    return static_cast<std::size_t>(std::max(1, tbb::info::default_concurrency()));
  return std::min(requested, kMostThreads);
}

void
parallelBlocks(std::size_t count,
               std::size_t block,
               std::size_t threads,
               const std::function<void(std::size_t begin, std::size_t end)>& body)
{
  if (count == 0)
    return;
  const std::size_t blocks = (count + block - 1) / block;
  const auto runBlock = [&](std::size_t b) { body(b * block, std::min(count, (b + 1) * block)); };
  if (threads <= 1 || blocks == 1) {
    for (std::size_t b = 0; b < blocks; ++b)
      runBlock(b);
    return;
  }
  // A process on fewer cores than asked for must still be able to run, and test, that many threads.
  tbb::global_control allowance(tbb::global_control::max_allowed_parallelism,
                                std::max(threads, tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)));
  tbb::task_arena arena(static_cast<int>(std::min<std::size_t>(threads, blocks)));
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks, 1), [&](const tbb::blocked_range<std::size_t>& range) {
      for (std::size_t b = range.begin(); b != range.end(); ++b)
        runBlock(b);
    });
  });
}

} // namespace pcl_gpf
