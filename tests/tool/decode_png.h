// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <png.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace pcl_gpf::test {

/** \brief A decoded picture, three bytes a pixel. */
struct Picture {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<unsigned char> rgb;

  /** \brief Pixels that differ from the one in the upper left corner. */
  std::size_t
  drawnPixels() const
  {
    std::size_t count = 0;
    for (std::size_t i = 0; i < rgb.size(); i += 3)
      count += rgb[i] != rgb[0] || rgb[i + 1] != rgb[1] || rgb[i + 2] != rgb[2];
    return count;
  }
};

/** \brief Decodes the bytes of a PNG file. \throws std::runtime_error when they are none */
inline Picture
decodePng(const std::string& bytes)
{
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()))
    throw std::runtime_error(header.message);
  header.format = PNG_FORMAT_RGB;
  Picture picture;
  picture.width = header.width;
  picture.height = header.height;
  picture.rgb.resize(PNG_IMAGE_SIZE(header));
  if (!png_image_finish_read(&header, nullptr, picture.rgb.data(), 0, nullptr))
    throw std::runtime_error(header.message);
  return picture;
}

} // namespace pcl_gpf::test
