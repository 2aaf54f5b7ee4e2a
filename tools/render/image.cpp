// SPDX-License-Identifier: BSD-3-Clause
#include "image.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl_gpf {

Image
halved(const Image& image)
{
  Image small(image.width / 2, image.height / 2, Color{});
  for (std::size_t row = 0; row < small.height; ++row)
    for (std::size_t column = 0; column < small.width; ++column)
      for (std::size_t channel = 0; channel < 3; ++channel)
        small.at(column, row)[channel] =
            0.25f * (image.at(2 * column, 2 * row)[channel] + image.at(2 * column + 1, 2 * row)[channel] +
                     image.at(2 * column, 2 * row + 1)[channel] + image.at(2 * column + 1, 2 * row + 1)[channel]);
  return small;
}

void
paste(const Image& part, std::size_t column, std::size_t row, Image& target)
{
  for (std::size_t r = 0; r < part.height; ++r)
    std::copy_n(&part.at(0, r), part.width, &target.at(column, row + r));
}

std::vector<unsigned char>
encodePng(const Image& image)
{
  std::vector<unsigned char> bytes;
  bytes.reserve(3 * image.pixels.size());
  for (const Color& color : image.pixels)
    for (const float value : color)
      bytes.push_back(static_cast<unsigned char>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f))));

  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::vector<unsigned char> file(size);
  if (!png_image_write_to_memory(&header, file.data(), &size, 0, bytes.data(), 0, nullptr))
    throw std::runtime_error(std::string("PNG: ") + header.message);
  file.resize(size);
  return file;
}

} // namespace pcl_gpf
