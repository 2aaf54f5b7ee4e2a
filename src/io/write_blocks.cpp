// SPDX-License-Identifier: BSD-3-Clause
#include "io/write_blocks.h"

#include <algorithm>
#include <cstring>

#include "io/element_bytes.h"

namespace pcl_gpf {

namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 20;

/** Calls \a encode for blocks of rows in the output's layout, of about 1 MiB each. */
template <typename Encode>
void forEachBlock(const CloudFile& cloud, const OutputLayout& layout, Encode encode) {
  const std::size_t step = cloud.pointStep();
  const std::size_t rows_per_block = std::max<std::size_t>(1, kBlockBytes / layout.step);
  std::vector<unsigned char> block(std::min(rows_per_block, cloud.size()) * layout.step);
  for (std::size_t first = 0; first < cloud.size(); first += rows_per_block) {
    const std::size_t rows = std::min(rows_per_block, cloud.size() - first);
    layout.map.apply(cloud.data.data() + first * step, step, block.data(), layout.step, rows);
    encode(block.data(), rows);
  }
}

bool hasLength(const CloudField& field, ListLengths lengths) {
  return lengths == ListLengths::Written && field.count > 1;
}

void appendText(FieldType type, const unsigned char* from, std::string& text) {
  char buffer[kMaxElementText];
  text.append(buffer, static_cast<std::size_t>(formatElement(type, from, buffer) - buffer));
  text += ' ';
}

/** Rows with list lengths in them: the layout with room, and one row that holds the lengths and nothing else. */
struct LengthPrefixedRows {
  std::size_t step = 0;
  RowMap map;
  std::vector<unsigned char> lengths;
};

LengthPrefixedRows prefixLengths(const OutputLayout& layout, ListLengths lengths, bool swap_bytes) {
  LengthPrefixedRows rows;
  for (const CloudField& field : layout.fields) {
    if (hasLength(field, lengths)) {
      const FieldType type = listLengthType(field.count);
      rows.lengths.resize(rows.step + sizeOf(type));
      storeElement(type, field.count, rows.lengths.data() + rows.step);
      if (swap_bytes) swapElements(rows.lengths.data() + rows.step, sizeOf(type), 1);
      rows.step += sizeOf(type);
    }
    const std::size_t bytes = sizeOf(field.type) * field.count;
    rows.map.add(field.offset, rows.step, bytes);
    rows.step += bytes;
    rows.lengths.resize(rows.step);
  }
  return rows;
}

} // namespace

FieldType listLengthType(std::uint32_t count) noexcept {
  return count < 256 ? FieldType::UInt8 : FieldType::UInt32;
}

void writeTextRows(const CloudFile& cloud, const OutputLayout& layout, ListLengths lengths, const ByteSink& sink) {
  std::string text;
  forEachBlock(cloud, layout, [&](const unsigned char* row, std::size_t rows) {
    for (std::size_t i = 0; i < rows; ++i, row += layout.step) {
      for (const CloudField& field : layout.fields) {
        if (hasLength(field, lengths)) text += std::to_string(field.count) + ' ';
        const std::size_t size = sizeOf(field.type);
        for (std::size_t k = 0; k < field.count; ++k)
          appendText(field.type, row + field.offset + k * size, text);
      }
      text.back() = '\n';
      if (text.size() < kBlockBytes) continue;
      sink(text.data(), text.size());
      text.clear();
    }
  });
  if (!text.empty()) sink(text.data(), text.size());
}

void writeBinaryRows(const CloudFile& cloud, const OutputLayout& layout, ListLengths lengths, bool swap_bytes,
                     const ByteSink& sink) {
  const LengthPrefixedRows prefixed = prefixLengths(layout, lengths, swap_bytes);
  const bool has_lengths = prefixed.step != layout.step;
  std::vector<unsigned char> rows_out;
  forEachBlock(cloud, layout, [&](unsigned char* block, std::size_t rows) {
    for (std::size_t i = 0; swap_bytes && i < rows; ++i)
      for (const CloudField& field : layout.fields)
        swapElements(block + i * layout.step + field.offset, sizeOf(field.type), field.count);
    if (!has_lengths) {
      sink(block, rows * layout.step);
      return;
    }
    rows_out.resize(rows * prefixed.step);
    for (std::size_t i = 0; i < rows; ++i)
      std::memcpy(rows_out.data() + i * prefixed.step, prefixed.lengths.data(), prefixed.step);
    prefixed.map.apply(block, layout.step, rows_out.data(), prefixed.step, rows);
    sink(rows_out.data(), rows_out.size());
  });
}

} // namespace pcl_gpf
