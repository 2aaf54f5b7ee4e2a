// SPDX-License-Identifier: BSD-3-Clause
#include "io/output_layout.h"

#include <algorithm>
#include <array>

#include "io/element_bytes.h"

namespace pcl_gpf {

namespace {

constexpr std::array<const char*, 4> kChannels = {"red", "green", "blue", "alpha"};

/** Where the byte of a channel lies in PCL's packed 0xAARRGGBB. */
constexpr std::size_t packedByte(std::size_t channel) {
  const std::size_t significance = channel == 3 ? 3 : 2 - channel;
  return kHostIsLittleEndian ? significance : 3 - significance;
}

bool isByteChannel(const CloudFile& cloud, std::size_t channel) {
  const int field = cloud.findField(kChannels[channel]);
  if (field < 0) return false;
  const CloudField& description = cloud.fields[static_cast<std::size_t>(field)];
  return description.type == FieldType::UInt8 && description.count == 1;
}

bool isFree(const CloudFile& cloud, const std::string& name) {
  return cloud.findField(name) < 0;
}

/** Number of single-byte channels to pack: 3 or 4, or 0 when there is nothing to pack or no name for it. */
std::size_t channelsToPack(const CloudFile& cloud) {
  const bool has_colour = isByteChannel(cloud, 0) && isByteChannel(cloud, 1) && isByteChannel(cloud, 2);
  if (!has_colour || !isFree(cloud, "rgb") || !isFree(cloud, "rgba")) return 0;
  return isByteChannel(cloud, 3) ? 4 : 3;
}

void copyField(const CloudField& field, const std::string& name, OutputLayout& layout) {
  const std::size_t to = layout.add(name, field.type, field.count);
  layout.map.add(field.offset, to, sizeOf(field.type) * field.count);
}

void packChannels(const CloudFile& cloud, std::size_t channels, OutputLayout& layout) {
  const bool has_alpha = channels == 4;
  const std::size_t to = layout.add(has_alpha ? "rgba" : "rgb", has_alpha ? FieldType::UInt32 : FieldType::Float32);
  for (std::size_t c = 0; c < channels; ++c) {
    const CloudField& field = cloud.fields[static_cast<std::size_t>(cloud.findField(kChannels[c]))];
    layout.map.add(field.offset, to + packedByte(c), 1);
  }
}

bool canUnpack(const CloudFile& cloud, const CloudField& field) {
  if (!isPackedColour(field)) return false;
  // With both rgb and rgba, the one with alpha is unpacked and the other kept as it is.
  if (field.name == "rgb" && !isFree(cloud, "rgba")) return false;
  return std::all_of(kChannels.begin(), kChannels.end(), [&](const char* name) { return isFree(cloud, name); });
}

void unpackChannels(const CloudField& field, OutputLayout& layout) {
  const std::size_t channels = field.name == "rgba" ? 4 : 3;
  for (std::size_t c = 0; c < channels; ++c) {
    const std::size_t to = layout.add(kChannels[c], FieldType::UInt8);
    layout.map.add(field.offset + packedByte(c), to, 1);
  }
}

/** A field `_` would be padding in PCD. */
std::string pcdName(const CloudFile& cloud, std::string name) {
  if (name != "_") return name;
  while (!isFree(cloud, name))
    name += '_';
  return name;
}

std::string plyName(const CloudFile& cloud, const std::string& name) {
  if (name != "normal_x" && name != "normal_y" && name != "normal_z") return name;
  const std::string short_name = "n" + name.substr(7);
  return isFree(cloud, short_name) ? short_name : name;
}

} // namespace

std::size_t OutputLayout::add(const std::string& name, FieldType type, std::uint32_t count) {
  const std::size_t offset = step;
  fields.push_back({name, type, count, offset});
  step += sizeOf(type) * count;
  return offset;
}

bool isPackedColour(const CloudField& field) noexcept {
  const bool has_name = field.name == "rgb" || field.name == "rgba";
  const bool has_type = sizeOf(field.type) == 4;
  return has_name && has_type && field.count == 1;
}

OutputLayout pcdLayout(const CloudFile& cloud) {
  OutputLayout layout;
  const std::size_t channels = channelsToPack(cloud);
  for (const CloudField& field : cloud.fields) {
    const auto channel =
        static_cast<std::size_t>(std::find(kChannels.begin(), kChannels.end(), field.name) - kChannels.begin());
    if (channel >= channels)
      copyField(field, pcdName(cloud, field.name), layout);
    else if (channel == 0)
      packChannels(cloud, channels, layout);
  }
  return layout;
}

OutputLayout plyLayout(const CloudFile& cloud) {
  OutputLayout layout;
  for (const CloudField& field : cloud.fields) {
    if (canUnpack(cloud, field))
      unpackChannels(field, layout);
    else
      copyField(field, plyName(cloud, field.name), layout);
  }
  return layout;
}

OutputLayout xyzLayout(const CloudFile& cloud) {
  OutputLayout layout;
  static constexpr const char* kFirst[] = {"x", "y", "z", "normal_x", "normal_y", "normal_z"};
  for (const char* name : kFirst) {
    const int field = cloud.findField(name);
    if (field >= 0) copyField(cloud.fields[static_cast<std::size_t>(field)], name, layout);
  }
  for (const CloudField& field : cloud.fields) {
    if (std::find(std::begin(kFirst), std::end(kFirst), field.name) != std::end(kFirst)) continue;
    if (canUnpack(cloud, field))
      unpackChannels(field, layout);
    else
      copyField(field, field.name, layout);
  }
  return layout;
}

} // namespace pcl_gpf
