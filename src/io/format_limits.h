// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_gpf {

// What a file may promise at most. The sizes of everything else follow from the bytes that are there.
constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxFields = 1000;
constexpr std::size_t kMaxElements = 10000;
constexpr std::uint64_t kMaxCount = (std::uint64_t{1} << 31) - 1;

} // namespace pcl_gpf
